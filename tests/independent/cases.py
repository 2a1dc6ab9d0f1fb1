"""What the programs with random cases share: the words of their command line, the loop over the cases on several cores, and its end."""
import argparse
import random
import sys
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path


def given(name, count, **more):
    """Words of the command line: the program, a directory (an empty one of this name is made in it), how many cases of which seed."""
    parser = argparse.ArgumentParser()
    parser.add_argument("binary", type=lambda text: str(Path(text).resolve()))
    parser.add_argument("directory", type=lambda text: Path(text) / name)
    parser.add_argument("--count", type=int, default=count)
    parser.add_argument("--seed", default="1")
    parser.add_argument("--jobs", type=int, default=2)
    for word, how in more.items():
        parser.add_argument(f"--{word}", **how)
    words = parser.parse_args()
    words.directory.mkdir(parents=True, exist_ok=True)
    for old in words.directory.iterdir():
        if old.is_file():
            old.unlink()
    return words


def judged(words, one):
    """Every case by `one`, which makes a state, a list of what is wrong and a command of a number and random numbers of its own; how many
    there were of each state, and how many were wrong."""
    states, failed = Counter(), 0

    def task(number):
        return number, one(number, random.Random(f"{words.seed}-{number}"))

    with ThreadPoolExecutor(words.jobs) as pool:
        for number, (state, wrong, command, *_) in pool.map(task, range(words.count)):
            states[state] += 1
            failed += bool(wrong)
            if wrong:
                print(f"  {number}: " + "\n    ".join([*wrong[:30], command]))
    return states, failed


def show_largest(largest):
    print("largest relative differences:")
    for what, share in sorted(largest.items()):
        print(f"  {what:60} {share:.1e}")


def finish(states, failed, more=""):
    print(", ".join(f"{n} {state}" for state, n in sorted(states.items())) + f"; {failed} wrong{more}")
    sys.exit(failed > 0)
