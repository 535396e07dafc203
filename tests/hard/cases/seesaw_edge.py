"""Small residuals are not enough here: solvers that stop at them differ by 9e-9. The bound of the error in the energy norm says what each has."""
from judge import near, require


def judge(run):
    near("force", run.pair("edge")["force"], [0, 0.4], absolute=1e-10)
    near("centre", run.pair("edge")["centre_of_pressure"], [0, 0], absolute=1e-10)
    solver = run.summary["solver"]
    require(solver["cross_check"]["displacement_difference"] < 1e-11, "the solvers differ")
    require(solver["energy_bound"]["kind"] == "exact" and solver["energy_bound"]["relative"] < 1e-12, "a bound of more than rounding")
