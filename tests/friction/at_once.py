"""The dragged block under loads that are there at t = 0: its upper side is pressed down and moved aside by 1e-3, then moved back by 2.5e-3 in one step.

Expected, with the pressure 1 and the limit 0.3 of friction: a shear stress of 0.3 is a shift of 6e-4. So the side slips by 4e-4 at once. It then sticks
until friction has turned, and slips back by 1.3e-3. Friction takes 0.6 times both, in parts of any length, if slip at once counts. Parts that begin
from nothing find less than the slip back."""
from judge import near, require


def judge(run):
    (step,) = run.summary["steps"]
    exact = 2 * 0.3 * (4e-4 + 1.3e-3)
    value, bar = (step["limit"][key]["pairs"]["floor"]["dissipation"] for key in ("values", "bars"))
    near("dissipation", [step["pairs"]["floor"]["dissipation"], step["energy"]["balance"]["dissipation"], value], [exact] * 3, relative=1e-9)
    require(bar <= 1e-8 * exact, f"bar {bar}")
    near("balance", step["energy"]["balance"]["defect"], step["energy"]["balance"]["work"] - step["energy"]["balance"]["stored"] - exact, absolute=1e-9 * exact)
