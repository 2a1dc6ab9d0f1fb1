//! First principles and random frames: nothing here shares a formula with the room, but for the names.

use super::*;
use camgen_kernel::numeric::quadrature;

/// SplitMix64 (G. L. Steele, D. Lea, C. H. Flood 2014): numbers between two bounds.
struct BrakeRandom(u64);

impl BrakeRandom {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        let bits = u32::try_from((z ^ (z >> 31)) >> 32).expect("32 bits");
        low + (high - low) * f64::from(bits) / f64::from(u32::MAX)
    }

    fn case(&mut self) -> (BrakeFrame, PaperRoll, f64, RollRotation) {
        let side = if self.between(0.0, 1.0) < 0.5 { 1.0 } else { -1.0 };
        let mut point = |x: (f64, f64), y: (f64, f64)| [self.between(x.0, x.1), self.between(y.0, y.1)];
        let mut frame = BrakeFrame {
            pivot: point((-1.8, 0.4), (-1.0, 1.6)),
            right_pulley: point((0.2, 1.0), (0.0, 1.0)),
            left_pulley: point((-1.0, -0.2), (0.0, 1.0)),
            centre_of_gravity: point((-0.8, 0.8), (-0.5, 1.5)),
            pulley_radius: 0.06,
        };
        if side < 0.0 {
            frame = mirrored(&frame);
        }
        let rotation =
            if self.between(0.0, 1.0) < 0.5 { RollRotation::Clockwise } else { RollRotation::CounterClockwise };
        frame.pulley_radius = self.between(0.02, 0.1);
        let roll = PaperRoll { largest_radius: self.between(0.3, 0.6), smallest_radius: self.between(0.03, 0.2) };
        (frame, roll, self.between(0.1, 0.5), rotation)
    }
}

fn mirrored(frame: &BrakeFrame) -> BrakeFrame {
    let over = |[x, y]: [f64; 2]| [-x, y];
    BrakeFrame {
        pivot: over(frame.pivot),
        right_pulley: over(frame.left_pulley),
        left_pulley: over(frame.right_pulley),
        centre_of_gravity: over(frame.centre_of_gravity),
        ..*frame
    }
}

/// Two points on the roll where a common tangent touches, the pulley on the other side of it, by bisecting the angle of the
/// tangent's normal n for p·n = R + ρ: `hand` is the side of the pulley towards which the belt runs on.
fn touch(pulley: [f64; 2], reach: f64, hand: f64) -> f64 {
    let [x, y] = pulley;
    let towards = libm::atan2(y, x);
    let (mut low, mut high) = (0.0, std::f64::consts::PI);
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        let (sine, cosine) = libm::sincos(towards + hand * middle);
        if x * cosine + y * sine > reach { low = middle } else { high = middle }
    }
    towards + hand * 0.5 * (low + high)
}

/// Moments about the pivot and the torque on the roll for a web tension, from the belt's pressure and friction on each piece of the
/// roll it lies on: what the pressure takes, what the weight gives.
fn by_contact(brake: &Brake, pose: &FramePose, weight: f64, tension: f64) -> [f64; 3] {
    let BrakeFrame { pivot: [ox, oy], pulley_radius, .. } = *brake.frame();
    let [right, left, [gx, _]] = brake.parts(pose);
    let reach = pose.radius + pulley_radius;
    let (n1, n2) = (touch(right, reach, 1.0), touch(left, reach, -1.0));
    let n2 = if n2 < n1 { n2 + std::f64::consts::TAU } else { n2 };
    let (slack, friction) = (tension / (libm::exp((n2 - n1) * brake.friction()) - 1.0), brake.friction());
    let clockwise = brake.rotation() == RollRotation::Clockwise;
    // The surface drags the belt its own way: tension falls from where it comes from.
    let way = if clockwise { -1.0 } else { 1.0 };
    let pressure = |angle: f64| {
        let from_slack = if clockwise { angle - n1 } else { n2 - angle };
        slack * libm::exp(friction * from_slack)
    };
    // On the belt: pressure outwards, friction with the surface.
    let force = |angle: f64| {
        let (sine, cosine) = libm::sincos(angle);
        let (p, t) = (pressure(angle), friction * pressure(angle) * way);
        ([p * cosine - t * sine, p * sine + t * cosine], [pose.radius * cosine, pose.radius * sine])
    };
    let moment = |angle: f64| {
        let ([fx, fy], [x, y]) = force(angle);
        (x - ox) * fy - (y - oy) * fx
    };
    let torque = |angle: f64| pose.radius * friction * pressure(angle);
    let about = quadrature::integrate(moment, (n1, n2), 8);
    [about, weight * (gx - ox), quadrature::integrate(torque, (n1, n2), 8) / pose.radius]
}

#[test]
fn contact_pressures_balance_the_weight_about_the_pivot() {
    let mut random = BrakeRandom(4);
    let (mut brakes, mut worst) = (0, 0.0_f64);
    while brakes < 300 {
        let (frame, roll, friction, rotation) = random.case();
        let Ok(brake) = Brake::new(frame, roll, friction, rotation) else { continue };
        brakes += 1;
        for share in [0.0, 0.37, 1.0] {
            let radius = roll.largest_radius + share * (roll.smallest_radius - roll.largest_radius);
            let pose = at(&brake, radius.max(roll.smallest_radius));
            let tension = brake.tension(1000.0, &pose);
            let [belt, weight, web] = by_contact(&brake, &pose, 1000.0, tension);
            let scale = weight.abs() + tension;
            worst = worst.max(((belt - weight) / scale).abs()).max((web / tension - 1.0).abs());
        }
    }
    assert!(worst < 1e-9, "{worst:e}");
}

/// The arms again from the touching points: moments of the two spans' tensions at the pivot.
#[test]
fn random_frames_are_balanced_or_named() {
    let mut random = BrakeRandom(2026);
    let mut walls = std::collections::BTreeMap::new();
    let mut worst = [0.0_f64; 3];
    for _ in 0..5000 {
        let (frame, roll, friction, rotation) = random.case();
        let brake = match Brake::new(frame, roll, friction, rotation) {
            Ok(brake) => brake,
            Err(wall) => {
                let name = format!("{wall:?}").split(' ').next().unwrap_or("").to_owned();
                assert!(format!("{wall}").contains("radius") && !name.contains("Not"), "{wall}");
                *walls.entry(name).or_insert(0) += 1;
                continue;
            }
        };
        *walls.entry("reaches".to_owned()).or_insert(0) += 1;
        for step in 0..=4 {
            let share = 0.25 * f64::from(step);
            let radius = roll.largest_radius * (1.0 - share) + roll.smallest_radius * share;
            let Ok(pose) = brake.at(radius.max(roll.smallest_radius)) else { panic!("{frame:?} at {radius}") };
            let tension = brake.tension(1000.0, &pose);
            let (slack, tight) = brake.belt_tensions(tension, &pose);
            let miss = 1000.0 * pose.h1 - slack * pose.q_slack - tight * pose.q_tight;
            let size = 1000.0 * pose.h1 + (slack * pose.q_slack).abs() + (tight * pose.q_tight).abs();
            worst[0] = worst[0].max((miss / size).abs());
            worst[1] = worst[1].max((length(&brake, &pose) / brake.belt_length() - 1.0).abs());
            worst[2] = worst[2].max(slope_miss(&brake, &pose));
        }
    }
    assert!(worst[0] < 1e-12 && worst[1] < 1e-12 && worst[2] < 1e-6, "{worst:?}");
    assert!(walls.len() == 6, "{walls:?}");
}

/// Down to just above its wall a frame is followed, to just below it is not; of every kind. The belt does not come off on the
/// way: taut, it is longer than the distance of the pulleys, and the frame changes neither.
#[test]
fn walls_are_where_they_are_named() {
    let mut random = BrakeRandom(9);
    let mut seen = [0; 5];
    for _ in 0..4000 {
        let (frame, roll, friction, rotation) = random.case();
        let Err(wall) = Brake::new(frame, roll, friction, rotation) else { continue };
        let (kind, radius) = match wall {
            BrakeError::PulleyMeetsRoll { radius, .. } => (0, radius),
            BrakeError::BeltLeavesRoll { radius } => (1, radius),
            BrakeError::DeadPoint { radius, .. } => (2, radius),
            BrakeError::Jams { radius, .. } => (3, radius),
            BrakeError::WeightLifts { radius } => (4, radius),
            other => panic!("{other}"),
        };
        if radius > roll.largest_radius - 1e-6 {
            continue;
        }
        seen[kind] += 1;
        let to = |smallest_radius| Brake::new(frame, PaperRoll { smallest_radius, ..roll }, friction, rotation);
        assert!(radius > roll.smallest_radius - 1e-9 && to(radius + 1e-9).is_ok(), "{wall}: {frame:?} {roll:?}");
        assert!(to(radius - 1e-9).is_err(), "{wall}: {frame:?} {roll:?}");
    }
    assert_eq!(seen[1], 0);
    assert!(seen.iter().enumerate().all(|(kind, count)| kind == 1 || *count > 20), "{seen:?}");
}

/// The taut belt from its touching points.
fn length(brake: &Brake, pose: &FramePose) -> f64 {
    let [right, left, _] = brake.parts(pose);
    let reach = pose.radius + brake.frame().pulley_radius;
    let (n1, n2) = (touch(right, reach, 1.0), touch(left, reach, -1.0));
    let n2 = if n2 < n1 { n2 + std::f64::consts::TAU } else { n2 };
    let span = |[x, y]: [f64; 2]| (x * x + y * y - reach * reach).sqrt();
    reach * (n2 - n1) + span(right) + span(left)
}

/// dθ/dR against a difference of fourth order, of its size where the frame is far from a dead point and pulleys.
fn slope_miss(brake: &Brake, pose: &FramePose) -> f64 {
    let h = 1e-4;
    let roll = brake.roll();
    let near = pose.q1 + pose.q2 < 0.1
        || pose.radius + 2.0 * h > roll.largest_radius
        || pose.radius - 2.0 * h < roll.smallest_radius
        || brake
            .parts(pose)
            .iter()
            .take(2)
            .any(|[x, y]| libm::hypot(*x, *y) < pose.radius + brake.frame().pulley_radius + 0.01);
    if near {
        return 0.0;
    }
    let theta = |n: f64| at(brake, pose.radius + n * h).theta;
    let difference = (8.0 * (theta(1.0) - theta(-1.0)) - (theta(2.0) - theta(-2.0))) / (12.0 * h);
    (difference / pose.theta_by_radius - 1.0).abs()
}

/// A mirror changes the side of the pivot, the turn's sign and nothing else.
#[test]
fn a_mirrored_brake_is_the_same_brake() {
    let other = Brake::new(mirrored(&frame()), ROLL, 0.25, RollRotation::CounterClockwise).expect("reaches");
    for radius in [0.6, 0.41, 0.05] {
        let (a, b) = (at(&brake(), radius), at(&other, radius));
        close(other.tension(1000.0, &b), brake().tension(1000.0, &a), 1e-14);
        assert!((a.theta + b.theta).abs() < 1e-14 && (a.q1 - b.q2).abs() < 1e-14 && (a.h1 - b.h1).abs() < 1e-14);
        assert!((a.theta_by_radius + b.theta_by_radius).abs() < 1e-12);
    }
    // Larger by a factor: all arms are, no tension is.
    let scale = |[x, y]: [f64; 2]| [3.0 * x, 3.0 * y];
    let f = frame();
    let large = BrakeFrame {
        pivot: scale(f.pivot),
        right_pulley: scale(f.right_pulley),
        left_pulley: scale(f.left_pulley),
        centre_of_gravity: scale(f.centre_of_gravity),
        pulley_radius: 3.0 * f.pulley_radius,
    };
    let roll = PaperRoll { largest_radius: 1.8, smallest_radius: 0.15 };
    let large = Brake::new(large, roll, 0.25, RollRotation::Clockwise).expect("reaches");
    close(large.tension(1000.0, &at(&large, 0.9)), brake().tension(1000.0, &at(&brake(), 0.3)), 1e-13);
}

/// E by the shaft's angle against ∫ M a/(q1 + q2) dR of a fine rule over the radius, which shares no station with it.
#[test]
fn the_work_of_random_discs_is_the_integral_over_the_radius() {
    let mut random = BrakeRandom(77);
    let (mut discs, mut worst) = (0, 0.0_f64);
    while discs < 100 {
        let (frame, roll, friction, rotation) = random.case();
        let Ok(brake) = Brake::new(frame, roll, friction, rotation) else { continue };
        let clear = |radius| {
            let pose = at(&brake, radius);
            let near = |[x, y]: [f64; 2]| libm::hypot(x, y) < radius + frame.pulley_radius + 0.02;
            pose.q1 + pose.q2 > 0.1 && !brake.parts(&pose).into_iter().take(2).any(near)
        };
        let PaperRoll { largest_radius: largest, smallest_radius: smallest } = roll;
        if !(clear(largest) && clear(smallest) && clear(0.5 * (largest + smallest))) {
            continue;
        }
        let holding = TensionHolding::new(brake.clone(), 500.0, 300.0, 0.5).expect("less than a turn");
        discs += 1;
        let by_radius = |radius: f64| {
            let pose = at(&brake, radius);
            holding.moment(&pose) * pose.theta_by_radius.abs()
        };
        let want = quadrature::integrate(by_radius, (smallest, largest), 48);
        let size = quadrature::integrate(|radius| by_radius(radius).abs(), (smallest, largest), 48);
        let got = holding.at(holding.total_angle()).expect("a place").energy;
        worst = worst.max(((got - want) / size).abs());
    }
    assert!(worst < 1e-10, "{worst:e}");
}
