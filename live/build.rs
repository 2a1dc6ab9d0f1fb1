//! What the page calls, and room for deep recursion: curves are fitted by halving.
fn main() {
    for exported in ["room", "run", "answer"] {
        println!("cargo::rustc-link-arg=--export={exported}");
    }
    println!("cargo::rustc-link-arg=-zstack-size=4194304");
}
