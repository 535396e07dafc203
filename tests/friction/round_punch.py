"""A round flat punch without slip: P / (G a delta) = 4 ln(3 - 4 nu) / (1 - 2 nu) (Spence 1968; Johnson 1985, section 3.7)."""
import math

from judge import near


def judge(run):
    for poisson in (0, 0.3):
        done = run.again("-block_poisson", str(poisson), name=f"p{poisson}")
        pair = done.pair("punch")
        near("nothing slips", pair["slip_share"], 0, absolute=1e-12)
        modulus = 1000 / (2 * (1 + poisson))
        near(f"force over modulus and depth, nu {poisson}", pair["normal_force"] / (modulus * 1e-3), 4 * math.log(3 - 4 * poisson) / (1 - 2 * poisson), relative=5e-3)
