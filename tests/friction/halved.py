"""The GRECO block under loads that grow, in halved steps. In n steps of length 1/n friction takes (1 + 1/n) times what it takes in infinitely many.
So the limit is exact, and all other numbers are those of one step."""
from judge import near, read_table, require


def judge(run):
    whole = run.again("-load_steps_halved", "0", name="whole").summary["steps"]
    (step,) = run.summary["steps"]
    balance, limit = step["energy"]["balance"], step["limit"]
    values, bars = limit["values"], limit["bars"]
    taken = balance["work"] - balance["stored"]
    near("dissipation of quarters", [balance["dissipation"], step["pairs"]["floor"]["dissipation"]], [1.25 * taken] * 2, relative=1e-8)
    near("defect of quarters", balance["defect"], -0.25 * taken, relative=1e-8)
    near("dissipation", [values["pairs"]["floor"]["dissipation"], values["energy"]["balance"]["dissipation"]], [taken] * 2, relative=1e-8)
    near("defect", values["energy"]["balance"]["defect"], 0, absolute=1e-8 * taken)
    require(bars["pairs"]["floor"]["dissipation"] >= 0.25 * taken, "the bar is narrower than what it was found from")
    for key in ("normal_force", "area", "max_pressure", "slip_share"):
        near(key, [values["pairs"]["floor"][key], step["pairs"]["floor"][key]], [whole[0]["pairs"]["floor"][key]] * 2, relative=1e-8)
        require(0 <= bars["pairs"]["floor"][key] <= 1e-8 * values["pairs"]["floor"][key], f"{key} has the bar {bars['pairs']['floor'][key]}")
    near("potential", values["energy"]["potential"], whole[0]["energy"]["potential"], relative=1e-8)
    near("reactions", values["reactions"]["block:right"], whole[0]["reactions"]["block:right"], absolute=1e-8 * abs(values["reactions"]["block:right"][0]))
    table = read_table(run.folder / "result_steps.csv")
    near("columns", [table["limit.floor.dissipation"][0], table["limit_bar.floor.tangential_force_x"][0]],
         [values["pairs"]["floor"]["dissipation"], bars["pairs"]["floor"]["tangential_force"][0]], relative=1e-15)
    require(run.stdout.count("steps in ") == 3, run.stdout)
