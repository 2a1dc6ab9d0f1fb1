//! A STEP file by its lines.

/// A file in lines, `#17 = …;` each.
pub(crate) struct Lines(pub(crate) Vec<String>);

impl Lines {
    pub(crate) fn of(text: &str) -> Self {
        Self(text.lines().map(str::to_owned).collect())
    }

    pub(crate) fn text(&self) -> String {
        self.0.join("\n") + "\n"
    }

    pub(crate) fn with(&self, index: usize, line: String) -> String {
        let mut lines = self.0.clone();
        lines[index] = line;
        lines.join("\n") + "\n"
    }

    /// The lines of a keyword.
    pub(crate) fn all(&self, keyword: &str) -> Vec<usize> {
        let part = format!(" = {keyword}(");
        (0..self.0.len()).filter(|i| self.0[*i].contains(&part)).collect()
    }

    pub(crate) fn line_of(&self, number: &str) -> usize {
        let start = format!("#{number} = ");
        self.0.iter().position(|line| line.starts_with(&start)).expect("defined")
    }

    /// Numbers of the instances a line refers to.
    pub(crate) fn references(&self, index: usize) -> Vec<String> {
        let digits = |part: &str| part.chars().take_while(char::is_ascii_digit).collect::<String>();
        self.0[index].split('#').skip(2).map(digits).collect()
    }

    /// A line with something added to one coordinate of its triple.
    pub(crate) fn moved(&self, index: usize, axis: usize, by: f64) -> String {
        let line = &self.0[index];
        let (head, rest) = line.split_once("('', (").expect("a triple");
        let mut numbers: Vec<f64> =
            rest.trim_end_matches("));").split(", ").map(|n| n.parse().expect("a number")).collect();
        numbers[axis] += by;
        self.with(index, format!("{head}('', ({:?}, {:?}, {:?}));", numbers[0], numbers[1], numbers[2]))
    }
}
