"""The two plates of the thesis on non-matching and matching meshes.

Non-matching: energy, force, largest displacement component, active nodes and steps of a prototype in another language (dense
saddle point of the same discretisation). Matching: dual mortar equals node-to-node there, values of a program that
knows no mortar. Reference: independent high-order computation.
"""
import numpy as np

from judge import near, require, same

# n_upper, n_lower, steps from the empty set, active, energy, contact force, largest displacement component
TABLE = [
    (2, 2, 3, 1, -4.2769057283e3, 1.5271359928e6, 1.295198e-3),
    (2, 3, 3, 1, -4.5873189292e3, 1.5310920401e6, 1.293768e-3),
    (4, 3, 2, 2, -5.1162418620e3, 1.7850250863e6, 1.553483e-3),
    (8, 6, 4, 3, -5.6374212604e3, 1.8062603361e6, 1.685485e-3),
    (16, 12, 4, 6, -5.8244833888e3, 1.8265044837e6, 1.743635e-3),
    (32, 24, 5, 11, -5.8871986805e3, 1.8327872798e6, 1.770567e-3),
    (64, 48, 6, 21, -5.9079132618e3, 1.8358396915e6, 1.780765e-3),
]
MATCHING = [(8, -5697.776743019175, 1812012.6512803554), (16, -5844.2407979466025, 1828281.6205272172)]
ENERGY, FORCE, ARM = -5918.263369, 1836995.0847, 0.0989860263
RATE = (1.4, 1.65)  # of the energy error between halvings: twice the 0.71..0.79 that the clamped corners allow in the norm


def plates(run, upper, lower, *more):
    return run.again("-upper_dm_plex_box_faces", f"{upper},{upper}", "-lower_dm_plex_box_faces", f"{lower},{lower}", *more,
                     name=f"n{upper}_{lower}" + "".join(more))


def judge(run):
    errors = []
    for upper, lower, steps, active, energy, force, largest in TABLE:
        again = plates(run, upper, lower)
        what = f"{upper}:{lower} "
        near(what + "energy", again.summary["energy"]["potential"], energy, relative=1e-8)
        near(what + "force", again.pair("joint")["normal_force"], force, relative=1e-8)
        same(what + "active nodes", again.pair("joint")["active_nodes"], active)
        same(what + "steps", again.summary["solver"]["iterations"], steps)
        with again.fields() as file:
            near(what + "largest displacement", float(np.abs(file["displacement"][()]).max()), largest, absolute=1e-9)
        errors.append(energy - ENERGY)
    for before, after in zip(errors[3:-1], errors[4:]):
        require(RATE[0] < np.log2(before / after) < RATE[1], f"energy converges at rate {np.log2(before / after):.3f}")
    near("force at 64:48", run.pair("joint")["normal_force"], FORCE, relative=1e-3)
    near("arm at 64:48", run.pair("joint")["centre_of_pressure"][0], ARM, relative=2e-3)
    reactions = plates(run, 16, 12, "-dm_refine", "0").summary["reactions"]
    near("reaction of the top", reactions["upper:top"], [-3e6, 2.1734955e6], relative=1e-7)
    near("reaction of the bottom", reactions["lower:bottom"], [3e6, 8.8265045e6], relative=1e-7)
    for n, energy, force in MATCHING:
        again = plates(run, n, n, "-cross_check")
        near(f"matching {n} energy", again.summary["energy"]["potential"], energy, relative=1e-9)
        near(f"matching {n} force", again.pair("joint")["normal_force"], force, relative=1e-9)
