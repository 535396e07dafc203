"""Flat sides whose rim is curved are flat: there a normal displacement of zero says what the scene says already, with displacements."""
from judge import near


def judge(run):
    other = run.again("-shell_bc_normal", "front,back", name="normal")
    near("potential", other.summary["energy"]["potential"], run.summary["energy"]["potential"], relative=1e-10)
