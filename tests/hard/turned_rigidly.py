"""A rigid motion has no strain of which a part could be neglected: the quotient of two roundings is none, and the theory of small displacements holds."""
from judge import near, same


def judge(run):
    found = run.summary["validity"]["indicators"]
    same("neglected strain", found["strain"]["value"], 0)
    same("colour", found["strain"]["colour"], "green")
    near("rotation", found["rotation"]["value"], 0.002, relative=1e-9)
