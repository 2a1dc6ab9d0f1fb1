//! What a body that is made of a disc has in common with it.

/// The methods of [`Body`](crate::body::Body) that are those of the disc in a field.
macro_rules! body_of_its_disc {
    ($disc:ident) => {
        fn machine(&self) -> &crate::machine::Machine {
            self.$disc.machine()
        }

        fn speeds(&self) -> crate::report::Speeds {
            self.$disc.speeds()
        }

        fn shaft_speed(&self) -> Option<f64> {
            self.$disc.shaft_speed()
        }

        fn shaft(&self) -> Option<crate::report::Shaft> {
            self.$disc.shaft()
        }

        fn parameter_at(&self, point: nalgebra::Vector2<f64>) -> f64 {
            self.$disc.parameter_at(point)
        }

        fn load(&self) -> Option<&dyn crate::body::LoadAsCut> {
            Some(&self.$disc)
        }

        fn smooth_stretches(&self) -> Vec<(usize, (f64, f64))> {
            self.$disc.smooth_stretches()
        }

        fn not_modelled(&self) -> Vec<&'static str> {
            self.$disc.not_modelled()
        }
    };
}

/// Methods of [`Figures`](crate::body::Figures) delegated to the disc in a field, and to the disc sized by `cam.base_radius`.
macro_rules! figures_of_its_disc {
    ($disc:ident, sized: $sized:ident) => {
        fn roller_radius(&self) -> Option<f64> {
            self.$disc.roller_radius()
        }

        fn touching(&self) -> crate::check::contact_stress::ContactKind {
            self.$disc.touching()
        }

        fn stress_remedies(&self, largest: f64, limit: f64) -> Vec<camgen_kernel::text::Remedy> {
            self.$sized.stress_remedies(largest, limit)
        }

        fn largest_lifting_force(&self) -> camgen_kernel::profile::Worst {
            self.$disc.largest_lifting_force()
        }

        fn least_closing_force(&self) -> Option<camgen_kernel::profile::Worst> {
            self.$disc.least_closing_force()
        }

        fn preload_that_holds(&self, speed: f64) -> Option<camgen_kernel::text::KeyChange> {
            self.$disc.preload_that_holds(speed)
        }

        fn remedy(&self) -> Option<camgen_kernel::text::Text> {
            self.$sized.remedy()
        }
    };
}

pub(in crate::body) use {body_of_its_disc, figures_of_its_disc};
