"""A cycle that shows itself indefinite, since the largest eigenvalue was estimated too low, smooths by shorter steps from then on."""
from judge import near, require

MOST = 20  # iterations of CG: 10 where the eigenvalue is known; without it there is no end to them


def judge(run):
    exact = run.summary["energy"]["potential"]
    for ranks in (1, 3):
        other = run.again("-pc_type", "truncatedmg", ranks=ranks, name=f"ranks{ranks}").summary
        near("energy", other["energy"]["potential"], exact, relative=1e-9)
        require(other["solver"]["linear_iterations"] <= MOST, f"{other['solver']['linear_iterations']} iterations on {ranks} ranks")
