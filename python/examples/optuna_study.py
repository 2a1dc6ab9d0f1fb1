"""The smallest cam of the lever that keeps a pressure angle, found by optuna: each trial is a design from Python.

Needs optuna 5 or later (pip install optuna); without it the example says so and ends.
"""

import sys

import camgen

try:
    import optuna
except ImportError:
    sys.exit("this example needs optuna: pip install optuna")

MACHINE = camgen.Machine.load("lever")


def size(trial):
    """The base radius, and by how much the pressure angle is too large."""
    base = trial.suggest_float("base_radius_mm", 20, 80)
    roller = trial.suggest_float("roller_radius_mm", 8, 20)
    overrides = {"cam.base_radius": f"{base} mm", "follower.swinging-roller.radius": f"{roller} mm"}
    try:
        cam = MACHINE.with_overrides(overrides).cam()
    except camgen.CamgenError:
        raise optuna.TrialPruned from None
    trial.set_constraint("pressure angle over 35 deg", cam.pressure_angle_deg - 35.0)
    trial.set_user_attr("pressure_angle_deg", cam.pressure_angle_deg)
    return base


if __name__ == "__main__":
    optuna.logging.set_verbosity(optuna.logging.WARNING)
    study = optuna.create_study(sampler=optuna.samplers.TPESampler(seed=1))
    study.optimize(size, n_trials=60)
    best = study.best_trial
    print(f"base radius {best.value:.2f} mm with a roller of {best.params['roller_radius_mm']:.2f} mm: {best.user_attrs['pressure_angle_deg']:.2f} deg")
