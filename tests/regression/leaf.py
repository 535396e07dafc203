"""A leaf spring slides by a quarter of the width of its narrow contact. The force is that of a curved beam by the principle of virtual forces, with the
height 2 cos(slope) and plane sections. Contact is narrow beside both sides, and no indicator warns of small displacements."""
from judge import near, require

MODULUS, LENGTH, DEFLECTION = 206e3 / (1 - 0.3**2), 30, 0.02
# integral of x^2 / (I cos(slope)) with the slope x / 50 and I = (2 cos(slope))^3 / 12
FLEXIBILITY = 12 / 8 * (LENGTH**3 / 3 + 2 * LENGTH**5 / (5 * 50**2) + LENGTH**7 / (7 * 50**4))


def judge(run):
    pair = run.pair("rest")
    slip = run.summary["validity"]["indicators"]["slip_contact"]["value"]
    require(8 * slip > 0.15 * pair["patches"][0]["extent"][0], "the slip, over the block's 8, is large beside the contact")
    roles = run.again("-rest_nonmortar", "block:top", "-rest_mortar", "leaf:bottom", warns=["coarse_contact"], name="roles")
    near("slip with exchanged roles", roles.summary["validity"]["indicators"]["slip_contact"]["value"], slip, relative=0.05)
    near("force with exchanged roles", roles.pair("rest")["normal_force"], pair["normal_force"], relative=1e-3)
    if run.ranks == 1:
        finer = run.again("-dm_refine", "1", warns=[], name="finer")
        near("force", finer.pair("rest")["normal_force"], DEFLECTION * MODULUS / FLEXIBILITY, relative=0.05)
        near("slip on the finer mesh", finer.summary["validity"]["indicators"]["slip_contact"]["value"], slip, relative=0.05)
