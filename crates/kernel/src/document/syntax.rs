//! What was probably meant where a text is not TOML, by the line of the first fault.

/// What is wrong with a line, and what would be right.
pub(super) struct SyntaxFault {
    pub(super) message: String,
    pub(super) help: String,
}

/// Marks that programs for texts put in the place of straight quotes.
const CURLED: [char; 8] = ['“', '”', '„', '‟', '‘', '’', '«', '»'];

/// The fault of a line that TOML refuses with these words; `repeated` says whether a table occurs several times. `None` where nothing
/// is known about it.
pub(super) fn fault_of(why: &str, line: &str, repeated: impl Fn(&str) -> bool) -> Option<SyntaxFault> {
    let line = line.trim();
    let fault = |message: String, help: String| Some(SyntaxFault { message, help });
    if line.contains(CURLED) {
        let help = format!("write straight quotes: {}", line.replace(CURLED, "\""));
        return fault("these quotes are those of printed texts".into(), help);
    }
    let header =
        line.strip_prefix('[').and_then(|rest| rest.split_once(']')).map(|(path, _)| path.trim_matches('[').trim());
    match header {
        Some(path) if why.contains("duplicate") && repeated(path) => {
            let help = format!("write [[{path}]], with two brackets, above each of them");
            return fault(format!("[{path}] is given more than once"), help);
        }
        Some(path) if why.contains("duplicate") => {
            let help = format!("a file has one table [{path}]: write its keys below one header");
            return fault(format!("[{path}] is given more than once"), help);
        }
        Some(_) => return None,
        None => {}
    }
    if line.starts_with("//") || line.starts_with(';') || line.starts_with("/*") {
        return fault("a comment begins with #".into(), format!("# {}", line.trim_start_matches(['/', ';', '*', ' '])));
    }
    if let Some((name, value)) = line.split_once('=') {
        let (name, value) = (name.trim(), value.split('#').next().unwrap_or_default().trim());
        if why.contains("duplicate") {
            return fault(format!("`{name}` is given twice in its table"), "remove one of them".into());
        }
        return value_fault(name, value).filter(|_| is_name(name));
    }
    match line.split_once(':').map(|(name, value)| (name.trim().trim_matches('"'), value.trim())) {
        Some((name, value)) if is_name(name) && !value.is_empty() => fault(
            "a key and its value are joined by =".into(),
            format!("write {name} = {}", value.trim_end_matches(',')),
        ),
        _ => match line.split_once(char::is_whitespace) {
            Some((name, value)) if is_name(name) && !value.trim().is_empty() => {
                fault("a key and its value are joined by =".into(), format!("write {name} = {}", value.trim()))
            }
            _ => None,
        },
    }
}

fn is_name(text: &str) -> bool {
    !text.is_empty() && text.chars().all(|c| c.is_ascii_alphanumeric() || matches!(c, '_' | '-' | '.'))
}

/// The fault of a value without quotes.
fn value_fault(name: &str, value: &str) -> Option<SyntaxFault> {
    let fault = |message: String, value: &str| Some(SyntaxFault { message, help: format!("write {name} = {value}") });
    if value.is_empty() {
        return Some(SyntaxFault {
            message: format!("`{name}` has no value"),
            help: "give one, or remove the key".into(),
        });
    }
    if value.starts_with(['"', '\'', '[', '{']) {
        return None;
    }
    let number = value.replacen(',', ".", 1);
    if value.contains(',') && number.parse::<f64>().is_ok() {
        return fault(format!("`{value}` has a comma: numbers have a decimal point"), &number);
    }
    let begins_a_number = value.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '-' | '+' | '.'));
    if begins_a_number && value.parse::<f64>().is_ok() {
        let digits = value.trim_start_matches(['+', '-']);
        let whole = if digits.starts_with('.') { value.replacen('.', "0.", 1) } else { format!("{value}0") };
        return fault(format!("`{value}` is not a number of TOML"), &whole);
    }
    let what = if begins_a_number { "a number with a unit" } else { "a text" };
    fault(format!("{what} needs quotes"), &format!("\"{}\"", value.trim_matches('"')))
}

#[cfg(test)]
mod tests {
    use super::*;
    use toml::de::DeTable;

    /// The help is right: where it is a line, TOML reads it.
    #[test]
    fn a_line_is_answered_with_what_was_meant() {
        for (line, message, help) in [
            ("radius = 12 mm", "a number with a unit needs quotes", "write radius = \"12 mm\""),
            ("radius = 12mm  # bought", "a number with a unit needs quotes", "write radius = \"12mm\""),
            ("law = cycloidal", "a text needs quotes", "write law = \"cycloidal\""),
            ("start = 0°", "a number with a unit needs quotes", "write start = \"0°\""),
            ("rpm = 1,5", "`1,5` has a comma: numbers have a decimal point", "write rpm = 1.5"),
            ("line = .5", "`.5` is not a number of TOML", "write line = 0.5"),
            ("line = 5.", "`5.` is not a number of TOML", "write line = 5.0"),
            ("rpm =", "`rpm` has no value", "give one, or remove the key"),
            ("radius: \"12 mm\"", "a key and its value are joined by =", "write radius = \"12 mm\""),
            ("rpm 120", "a key and its value are joined by =", "write rpm = 120"),
            (
                "radius = “12 mm”",
                "these quotes are those of printed texts",
                "write straight quotes: radius = \"12 mm\"",
            ),
            ("// the roller", "a comment begins with #", "# the roller"),
        ] {
            let (_, errors) = DeTable::parse_recoverable(line);
            let why = errors.first().unwrap_or_else(|| panic!("{line} is TOML")).message();
            let found = fault_of(why, line, |_| false).expect(line);
            assert_eq!((found.message.as_str(), found.help.as_str()), (message, help), "{line}: {why}");
            let meant = help.strip_prefix("write straight quotes: ").or(help.strip_prefix("write "));
            assert!(meant.is_none_or(|line| DeTable::parse(line).is_ok()), "{help}");
        }
    }

    #[test]
    fn what_is_given_twice_is_told() {
        for (text, at, message, help) in [
            (
                "[a.b]\nx = 1\n[a.b]\n",
                "[a.b]",
                "[a.b] is given more than once",
                "write [[a.b]], with two brackets, above each of them",
            ),
            (
                "[a]\nx = 1\n[a]\n",
                "[a]",
                "[a] is given more than once",
                "a file has one table [a]: write its keys below one header",
            ),
            ("x = 1\nx = 2\n", "x = 2", "`x` is given twice in its table", "remove one of them"),
        ] {
            let (_, errors) = DeTable::parse_recoverable(text);
            let found = fault_of(errors[0].message(), at, |path| path == "a.b").expect(text);
            assert_eq!((found.message.as_str(), found.help.as_str()), (message, help), "{}", errors[0].message());
        }
    }
}
