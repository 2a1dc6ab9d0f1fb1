//! The motion of a counter disc: what is left of the largest lift, turned about the shaft.

use camgen_kernel::motion::{Jet, Motion, Piece, Quantity};
use std::f64::consts::TAU;
use std::sync::Arc;

/// The lift h − s(θ − turn).
#[derive(Debug)]
pub(in crate::body) struct CounterMotion {
    main: Arc<dyn Motion>,
    pieces: Vec<Piece>,
    /// Largest lift h, m or rad.
    top: f64,
    turn: f64,
}

impl CounterMotion {
    pub(in crate::body) fn new(main: Arc<dyn Motion>, top: f64, turn: f64) -> Self {
        // A turn begins within one turn about 0.
        let turn = if main.range().0 + turn < TAU { turn } else { turn - TAU };
        let turned = |piece: &Piece| Piece { start: piece.start + turn, end: piece.end + turn, ..*piece };
        let pieces = main.pieces().iter().map(turned).collect();
        Self { main, pieces, top, turn }
    }
}

impl Motion for CounterMotion {
    fn pieces(&self) -> &[Piece] {
        &self.pieces
    }

    fn jet(&self, piece: usize, parameter: f64) -> Jet {
        let Jet { s, ds, dds, ddds } = self.main.jet(piece, parameter - self.turn);
        Jet { s: self.top - s, ds: -ds, dds: -dds, ddds: -ddds }
    }

    fn is_rolled(&self, piece: usize) -> bool {
        self.main.is_rolled(piece)
    }

    fn quantity(&self) -> Quantity {
        self.main.quantity()
    }

    fn lobes(&self) -> u32 {
        self.main.lobes()
    }

    fn repeats(&self, piece: usize) -> (usize, bool) {
        self.main.repeats(piece)
    }

    fn cells(&self, piece: usize) -> u32 {
        self.main.cells(piece)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use camgen_kernel::motion::EccentricCircle;
    use camgen_kernel::motion::contract;

    #[test]
    fn it_keeps_the_contract_of_a_motion_and_adds_up_to_the_largest_lift() {
        let main: Arc<dyn Motion> = Arc::new(EccentricCircle::new(0.01, 0.06));
        let turn = std::f64::consts::PI;
        let counter = || CounterMotion::new(Arc::clone(&main), 0.02, turn);
        _ = contract::kept_by(&[("counter".to_owned(), Box::new(counter()) as Box<dyn Motion>)]);
        let counter = counter();
        for i in 0..36 {
            let angle = 10.0_f64.to_radians() * f64::from(i);
            let at = |motion: &dyn Motion, angle: f64| {
                let (piece, inside) = motion.locate(angle);
                motion.jet(piece, inside)
            };
            let (own, other) = (at(&*main, angle), at(&counter, angle + turn));
            assert!((own.s + other.s - 0.02).abs() < 1e-15 && (own.ddds + other.ddds).abs() < 1e-14, "{i}");
        }
    }
}
