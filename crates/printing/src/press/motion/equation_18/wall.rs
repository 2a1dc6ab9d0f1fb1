//! Walls: overruns beyond which no plate solves equation (18), and what would avoid them.

use camgen_kernel::refusal::Refusal;

/// No slope to start with, for an angle Δ and a friction angle ρ (rad).
pub(super) fn no_start(delta: f64, friction_angle: f64) -> Refusal {
    let [delta, friction] = [delta, friction_angle].map(f64::to_degrees);
    Refusal::new(format!(
        "equation (18) has no starting slope: with delta {delta:.3} deg and friction angle {friction:.3} deg the \
         flank jams at once"
    ))
    .remedy("a smaller translating.friction_angle or a translating.delta nearer 90 deg would avoid it")
}

/// At an overrun, m.
fn wall(x: f64, what: impl Into<String>, remedies: &str) -> Refusal {
    Refusal::new(what).at(format!("x = {:.6} mm", 1e3 * x)).remedy(format!("{remedies} would avoid it"))
}

/// sin(θ−α) → 0.
pub(super) fn slope(x: f64) -> Refusal {
    let remedies = "a smaller translating.friction_angle, a better efficiency or a longer buffer.column";
    wall(
        x,
        "the slope of the bottom grows without bound (sin(θ−α) → 0: the roller's path lies along the flank)",
        remedies,
    )
}

/// sin θ → 0.
pub(super) fn line(x: f64) -> Refusal {
    let remedies = "a translating.delta nearer 90 deg or a longer translating.bottom_arm";
    wall(x, "the roller moves along the bed's line, where no flank moves it (sin θ → 0)", remedies)
}

/// |Δx| → l2, m.
pub(super) fn arm(x: f64, bottom_arm: f64) -> Refusal {
    let what = format!("the bottom's arm is used up (|Δx| → {:.3} mm)", 1e3 * bottom_arm);
    wall(x, what, "a longer translating.bottom_arm")
}

/// L − x − Δx → 0.
pub(super) fn column(x: f64) -> Refusal {
    wall(x, "the air column is used up (x + Δx → L)", "a longer buffer.column")
}

/// sin[θ−(α+ρ)] → 0.
pub(super) fn jam(x: f64) -> Refusal {
    let remedies =
        "a smaller translating.friction_angle, a smaller arm of the bottom against the roller's, or `--solver ode`";
    wall(x, "the flank jams (sin[θ−(α+ρ)] → 0 in (18))", remedies)
}

/// x + Δx → 0.
pub(super) fn stiff(x: f64) -> Refusal {
    let what = "the bottom moves away as fast as the bed approaches (x + Δx → 0), and equation (18) is too stiff to \
                be followed";
    wall(x, what, "a longer buffer.column")
}

/// Too many steps, for none of the reasons above.
pub(super) fn unnamed(x: f64) -> Refusal {
    let remedies = "a longer translating.bottom_arm, a smaller translating.friction_angle or a longer buffer.column";
    wall(x, "equation (18) could not be continued, because the bottom moves too steeply", remedies)
}
