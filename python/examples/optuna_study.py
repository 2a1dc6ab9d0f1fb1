"""The smallest cam of the lever that keeps a pressure angle, found by optuna: each trial is a design from Python.

Needs optuna (pip install optuna); without it the example says so and ends.
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
    trial.set_user_attr("excess", (cam.pressure_angle_deg - 35.0,))
    return base


if __name__ == "__main__":
    optuna.logging.set_verbosity(optuna.logging.WARNING)
    sampler = optuna.samplers.TPESampler(seed=1, constraints_func=lambda trial: trial.user_attrs.get("excess", (1.0,)))
    study = optuna.create_study(sampler=sampler)
    study.optimize(size, n_trials=60)
    kept = [trial for trial in study.trials if trial.value is not None and trial.user_attrs.get("excess", (1.0,))[0] <= 0.0]
    best = min(kept, key=lambda trial: trial.value)
    print(f"base radius {best.value:.2f} mm with a roller of {best.params['roller_radius_mm']:.2f} mm: {35 + best.user_attrs['excess'][0]:.2f} deg")
