//! What domains read of a machine file in addition to the cam.

use std::any::{Any, TypeId};
use std::fmt;
use std::sync::Arc;

/// What a domain reads of a machine file.
pub trait MachinePart: Any + fmt::Debug + Send + Sync {}

impl<T: Any + fmt::Debug + Send + Sync> MachinePart for T {}

/// What domains have read of a file: at most one value of each type.
#[derive(Debug, Clone, Default)]
pub struct MachineParts(Vec<(TypeId, Arc<dyn MachinePart>)>);

impl MachineParts {
    /// The value of a type.
    #[must_use]
    pub fn get<T: MachinePart>(&self) -> Option<&T> {
        let (_, part) = self.0.iter().find(|(id, _)| *id == TypeId::of::<T>())?;
        let part: &dyn Any = &**part;
        part.downcast_ref()
    }

    /// Puts a value in the place of one of its type.
    pub fn set<T: MachinePart>(&mut self, part: T) {
        let id = TypeId::of::<T>();
        let part: Arc<dyn MachinePart> = Arc::new(part);
        match self.0.iter_mut().find(|(other, _)| *other == id) {
            Some((_, old)) => *old = part,
            None => self.0.push((id, part)),
        }
    }

    /// Takes out the value of a type.
    pub fn remove<T: MachinePart>(&mut self) {
        self.0.retain(|(id, _)| *id != TypeId::of::<T>());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_type_has_one_value() {
        let mut parts = MachineParts::default();
        parts.set(1_u32);
        parts.set(2.0_f64);
        parts.set(3_u32);
        assert_eq!((parts.get(), parts.get(), parts.get::<i8>()), (Some(&3_u32), Some(&2.0_f64), None));
        let other = parts.clone();
        parts.remove::<u32>();
        assert_eq!((parts.get::<u32>(), other.get()), (None, Some(&3_u32)));
    }
}
