//! Materials of cams: four classes, the names that shops write, and any other text.

use camgen_kernel::document::similar;

/// Material of a cam, for its mass and the pressure in its contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Material {
    /// Carbon and low-alloy steel.
    Steel,
    /// Grey cast iron.
    CastIron,
    /// Tin bronze.
    Bronze,
    /// Wrought aluminium alloy.
    Aluminium,
}

/// The classes by their names.
const CLASSES: [(&str, Material); 4] = [
    ("steel", Material::Steel),
    ("cast-iron", Material::CastIron),
    ("bronze", Material::Bronze),
    ("aluminium", Material::Aluminium),
];

impl Material {
    /// As the machine file names it.
    #[must_use]
    pub fn name(self) -> &'static str {
        CLASSES.iter().find(|(_, class)| *class == self).map_or("", |(name, _)| name)
    }

    /// The state in which its customary limit of contact stress holds.
    #[must_use]
    pub fn customary_state(self) -> &'static str {
        match self {
            Material::Steel => "hardened steel",
            Material::CastIron => "cast iron",
            Material::Bronze => "bronze",
            Material::Aluminium => "aluminium",
        }
    }

    /// E, Pa, customary values.
    #[must_use]
    pub fn modulus(self) -> f64 {
        match self {
            Material::Steel => 210e9,
            Material::CastIron | Material::Bronze => 110e9,
            Material::Aluminium => 70e9,
        }
    }

    /// Poisson's ratio, customary values.
    #[must_use]
    pub fn poisson(self) -> f64 {
        match self {
            Material::Steel => 0.30,
            Material::CastIron => 0.26,
            Material::Bronze => 0.34,
            Material::Aluminium => 0.33,
        }
    }

    /// E/(1 − ν²), Pa, customary values.
    #[must_use]
    pub fn contact_modulus(self) -> f64 {
        let poisson = self.poisson();
        self.modulus() / (1.0 - poisson * poisson)
    }

    /// Density, kg/m³, customary values.
    #[must_use]
    pub fn density(self) -> f64 {
        match self {
            Material::Steel => 7850.0,
            Material::CastIron => 7200.0,
            Material::Bronze => 8800.0,
            Material::Aluminium => 2700.0,
        }
    }
}

/// How the surface of a cam is treated, which decides the pressure that it bears.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Treatment {
    /// Normalised, of a hardness HB.
    Normalised(f64),
    /// Quenched and tempered, of a hardness HV.
    Tempered(f64),
    /// Hardened in a case, or through as a bearing steel.
    Hardened,
    /// Grey cast iron, of a hardness HB.
    GreyIron(f64),
    /// Nodular cast iron, of a hardness HB.
    NodularIron(f64),
    /// That of the class.
    OfClass,
}

/// A name that shops write.
#[derive(Debug, PartialEq)]
pub struct Grade {
    /// Its names: by standards old and new, and its number. The first is the one that reports show.
    names: &'static [&'static str],
    class: Material,
    treatment: Treatment,
}

const fn grade(class: Material, treatment: Treatment, names: &'static [&'static str]) -> Grade {
    Grade { names, class, treatment }
}

/// The grades, in the state in which they are usually bought.
const GRADES: &[Grade] = &[
    grade(
        Material::Steel,
        Treatment::Normalised(120.0),
        &["S235", "S235JR", "St37", "St37-2", "1.0037", "1.0038", "A36"],
    ),
    grade(Material::Steel, Treatment::Normalised(160.0), &["S355", "S355J2", "St52", "St52-3", "1.0577", "1.0570"]),
    grade(
        Material::Steel,
        Treatment::Normalised(190.0),
        &["C45", "C45E", "Ck45", "1.0503", "1.1191", "S45C", "AISI 1045", "1045"],
    ),
    grade(Material::Steel, Treatment::Normalised(210.0), &["C60", "C60E", "Ck60", "1.0601", "1.1221"]),
    grade(
        Material::Steel,
        Treatment::Tempered(300.0),
        &["42CrMo4", "42CrMoS4", "1.7225", "SCM440", "AISI 4140", "4140"],
    ),
    grade(Material::Steel, Treatment::Tempered(310.0), &["34CrNiMo6", "1.6582", "AISI 4340", "4340"]),
    grade(Material::Steel, Treatment::Tempered(300.0), &["50CrMo4", "1.7228", "51CrV4", "50CrV4", "1.8159"]),
    grade(Material::Steel, Treatment::Hardened, &["16MnCr5", "16MnCrS5", "1.7131", "1.7139"]),
    grade(Material::Steel, Treatment::Hardened, &["20MnCr5", "20MnCrS5", "1.7147", "1.7149"]),
    grade(Material::Steel, Treatment::Hardened, &["18CrNiMo7-6", "17CrNiMo6", "1.6587", "AISI 8620", "8620"]),
    grade(Material::Steel, Treatment::Hardened, &["C15", "C15E", "Ck15", "1.0401", "1.1141"]),
    grade(Material::Steel, Treatment::Hardened, &["100Cr6", "102Cr6", "1.3505", "SUJ2", "AISI 52100", "52100"]),
    grade(
        Material::Steel,
        Treatment::Hardened,
        &["90MnCrV8", "1.2842", "O2", "X153CrMoV12", "X155CrVMo12-1", "1.2379", "D2"],
    ),
    grade(Material::CastIron, Treatment::GreyIron(180.0), &["EN-GJL-200", "GG20", "GGL20", "0.6020", "EN-JL1030"]),
    grade(Material::CastIron, Treatment::GreyIron(200.0), &["EN-GJL-250", "GG25", "GGL25", "0.6025", "EN-JL1040"]),
    grade(Material::CastIron, Treatment::GreyIron(220.0), &["EN-GJL-300", "GG30", "GGL30", "0.6030", "EN-JL1050"]),
    grade(Material::CastIron, Treatment::NodularIron(180.0), &["EN-GJS-500-7", "GGG50", "0.7050", "EN-JS1050"]),
    grade(Material::CastIron, Treatment::NodularIron(220.0), &["EN-GJS-600-3", "GGG60", "0.7060", "EN-JS1060"]),
    grade(Material::CastIron, Treatment::NodularIron(250.0), &["EN-GJS-700-2", "GGG70", "0.7070", "EN-JS1070"]),
    grade(
        Material::Bronze,
        Treatment::OfClass,
        &["CuSn12", "CuSn12-C", "GC-CuSn12", "GBZ12", "CuSn8", "2.1052", "CC483K"],
    ),
    grade(
        Material::Aluminium,
        Treatment::OfClass,
        &["EN AW-7075", "AW-7075", "7075", "AlZn5.5MgCu", "AlZnMgCu1.5", "3.4365"],
    ),
    grade(
        Material::Aluminium,
        Treatment::OfClass,
        &["EN AW-6082", "AW-6082", "6082", "AlMgSi1", "AlSi1MgMn", "3.2315"],
    ),
    grade(
        Material::Aluminium,
        Treatment::OfClass,
        &["EN AW-2017", "AW-2017", "2017", "AlCuMg1", "AlCu4MgSi", "3.1325", "aluminum"],
    ),
];

/// Case-hardening steels by their first names (ISO 683-3); the other hardened grades are hardened through.
const CASE_HARDENED: [&str; 4] = ["16MnCr5", "20MnCr5", "18CrNiMo7-6", "C15"];

fn is_case_hardened(names: &[&str]) -> bool {
    names.first().is_some_and(|name| CASE_HARDENED.contains(name))
}

/// The letters and digits of a name: `42 CrMo 4` is `42CrMo4`.
fn folded(name: &str) -> String {
    name.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}

impl Grade {
    /// Largest pressure in a line of contact with a steel roller, Pa, and where it is from; `None` where it is that of the class.
    ///
    /// The endurance limits for contact of ISO 6336-5:2003, table 1, quality MQ: σ = A x + B, MPa, with the hardness x. They are those of
    /// lines that roll and slide under repeated load, as cam and roller do.
    fn limit(&self) -> Option<(f64, String)> {
        let (a, x, b, state) = match self.treatment {
            Treatment::OfClass => return None,
            Treatment::Normalised(hardness) => (1.0, hardness, 190.0, format!("normalised, {hardness} HB")),
            Treatment::Tempered(hardness) => (1.313, hardness, 373.0, format!("quenched and tempered, {hardness} HV")),
            Treatment::Hardened => (0.0, 0.0, 1500.0, "hardened, at least 58 HRC".to_owned()),
            Treatment::GreyIron(hardness) => (1.033, hardness, 132.0, format!("as cast, {hardness} HB")),
            Treatment::NodularIron(hardness) => (1.434, hardness, 211.0, format!("as cast, {hardness} HB")),
        };
        // In whole multiples of 10 MPa, as such figures are given.
        let limit = 10.0 * ((a * x + b) / 10.0).floor();
        Some((1e6 * limit, state))
    }
}

/// The material of a cam as a file gives it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CamMaterial {
    /// Its class, for density and modulus; steel of another material.
    pub class: Material,
    source: Source,
    /// The largest pressure in a line of contact that the file gives for it, Pa.
    limit: Option<f64>,
}

/// What is known of a material.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Source {
    /// Its class was named.
    Class,
    Grade(&'static Grade),
    /// Nothing but its name.
    Other,
}

impl CamMaterial {
    /// A material by its name, with the largest pressure in a line of contact that is given for it, Pa.
    ///
    /// # Errors
    /// The class that a name probably means.
    pub(crate) fn named(name: &str, limit: Option<f64>) -> Result<Self, &'static str> {
        let name = name.trim();
        if let Some((_, class)) = CLASSES.iter().find(|(known, _)| folded(known) == folded(name)) {
            return Ok(Self { class: *class, source: Source::Class, limit });
        }
        if let Some(grade) = GRADES.iter().find(|grade| grade.names.iter().any(|known| folded(known) == folded(name))) {
            return Ok(Self { class: grade.class, source: Source::Grade(grade), limit });
        }
        let near = similar(name, CLASSES.iter().map(|(known, _)| *known))
            .filter(|_| !name.contains(|c: char| c.is_ascii_digit()));
        match near {
            Some(near) if limit.is_none() => Err(near),
            _ => Ok(Self { class: Material::Steel, source: Source::Other, limit }),
        }
    }

    /// Largest pressure in a line of contact with a steel roller, Pa, of the file or of the grade; `None` where it is that of the class, or where
    /// nothing is known of the material.
    #[must_use]
    pub fn line_limit(&self) -> Option<f64> {
        self.limit.or_else(|| match self.source {
            Source::Grade(grade) => grade.limit().map(|(limit, _)| limit),
            Source::Class | Source::Other => None,
        })
    }

    /// The state of the material that its customary limit is for, which nobody has stated: "hardened steel". `None` where the file gives the
    /// limit, or where none is known.
    #[must_use]
    pub fn assumed_state(&self) -> Option<String> {
        match (self.limit, self.source) {
            (None, Source::Class) => Some(self.class.customary_state().to_owned()),
            (None, Source::Grade(grade)) => {
                let state = grade.limit().map(|(_, state)| state);
                let state = state.unwrap_or_else(|| self.class.customary_state().to_owned());
                Some(format!("{}, {state},", grade.names.first().unwrap_or(&"")))
            }
            (Some(_), _) | (None, Source::Other) => None,
        }
    }

    /// Whether a hardened surface is presumed of a steel without a grade.
    #[must_use]
    pub fn needs_a_grade(&self) -> bool {
        self.limit.is_none() && self.class == Material::Steel && self.source == Source::Class
    }

    /// The treatment, with the hardness, that a limit which nobody has stated presumes, as a drawing asks for it; `None` where the file gives the
    /// limit, or where the material is used as it is cast or drawn.
    #[must_use]
    pub fn presumed_treatment(&self) -> Option<String> {
        if self.limit.is_some() || self.class != Material::Steel {
            return None;
        }
        match self.source {
            Source::Grade(Grade { treatment: Treatment::Normalised(hardness), .. }) => {
                Some(format!("normalised, {hardness}+30 HB"))
            }
            Source::Grade(Grade { treatment: Treatment::Tempered(hardness), .. }) => {
                Some(format!("quenched, tempered, {hardness}+40 HV"))
            }
            Source::Grade(Grade { treatment: Treatment::Hardened, names, .. }) if is_case_hardened(names) => {
                Some("case-hardened, 58+4 HRC, CHD 0.8+0.4".to_owned())
            }
            Source::Grade(_) | Source::Class => Some("hardened, 58+4 HRC".to_owned()),
            Source::Other => None,
        }
    }

    /// Whether more than its name is known.
    #[must_use]
    pub fn is_known(&self) -> bool {
        self.source != Source::Other
    }

    /// What the limit is that of, where it is not that of a class, and where it is from.
    #[must_use]
    pub fn limit_words(&self) -> Option<String> {
        match (self.limit, self.source) {
            (Some(_), _) => Some("cam.contact_limit".to_owned()),
            (None, Source::Grade(grade)) => grade.limit().map(|(_, state)| {
                format!(
                    "the customary limit of {} ({state}; ISO 6336-5, quality MQ)",
                    grade.names.first().unwrap_or(&"")
                )
            }),
            (None, _) => None,
        }
    }

    /// What its name was taken for, where that was not one of the classes; `name` as typed.
    #[must_use]
    pub fn note(&self, name: &str) -> Option<String> {
        let (class, modulus, density) = (self.class.name(), 1e-9 * self.class.modulus(), self.class.density());
        let as_class = format!("{modulus} GPa and {density} kg/m³ of {class}");
        let limit = || match (self.line_limit(), self.limit_words()) {
            (Some(limit), Some(words)) => {
                let other = if self.limit.is_some() { "" } else { "; in another state give cam.contact_limit" };
                format!("{:.0} MPa along a line, {words}{other}", 1e-6 * limit)
            }
            _ if self.is_known() => format!("the customary limit of {class}"),
            _ => "no limit of the contact stress is known: give cam.contact_limit".to_owned(),
        };
        match self.source {
            Source::Class => None,
            Source::Grade(_) => Some(format!("cam.material \"{name}\": {as_class}; {}", limit())),
            Source::Other => Some(format!("cam.material \"{name}\" is not known: {as_class} are taken; {}", limit())),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read_as_shops_write_them() {
        for (name, class, limit) in [
            ("steel", Material::Steel, None),
            ("Cast iron", Material::CastIron, None),
            ("C45", Material::Steel, Some(380.0)),
            ("c 45", Material::Steel, Some(380.0)),
            ("1.0503", Material::Steel, Some(380.0)),
            ("42CrMo4", Material::Steel, Some(760.0)),
            ("42 CrMo 4", Material::Steel, Some(760.0)),
            ("16MnCr5", Material::Steel, Some(1500.0)),
            ("100Cr6", Material::Steel, Some(1500.0)),
            ("GG25", Material::CastIron, Some(330.0)),
            ("GG-25", Material::CastIron, Some(330.0)),
            ("EN-GJS-500-7", Material::CastIron, Some(460.0)),
            ("CuSn12", Material::Bronze, None),
            ("AlMgSi1", Material::Aluminium, None),
        ] {
            let found = CamMaterial::named(name, None).expect(name);
            assert_eq!((found.class, found.line_limit().map(|limit| (1e-6 * limit).round())), (class, limit), "{name}");
            assert_eq!(found.note(name).is_none(), found.source == Source::Class, "{name}");
            let given = CamMaterial::named(name, Some(9e8)).expect(name).line_limit();
            assert_eq!(given, Some(9e8), "{name}");
        }
    }

    #[test]
    fn other_names_have_no_limit_but_a_given_one() {
        let other = CamMaterial::named("POM-C", None).expect("any text");
        assert_eq!((other.class, other.line_limit(), other.is_known()), (Material::Steel, None, false));
        assert!(other.note("POM-C").is_some_and(|note| note.contains("give cam.contact_limit")));
        let given = CamMaterial::named("POM-C", Some(4e7)).expect("any text");
        assert_eq!(given.line_limit(), Some(4e7));
        assert_eq!(CamMaterial::named("steal", None), Err("steel"));
        assert_eq!(CamMaterial::named("cast irn", None), Err("cast-iron"));
    }

    #[test]
    fn no_name_is_that_of_two_grades() {
        let mut names: Vec<String> =
            GRADES.iter().flat_map(|grade| grade.names.iter().map(|name| folded(name))).collect();
        let all = names.len();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), all);
    }
}
