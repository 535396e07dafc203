from judge import near

SLIVER = 1e-6  # of a facet


def judge(run):
    twin = run.again("-lower_dm_plex_box_upper", "0.6,0", name="without")
    near("force", run.pair("joint")["force"], twin.pair("joint")["force"], relative=10 * SLIVER)
    near("energy", run.summary["energy"]["potential"], twin.summary["energy"]["potential"], relative=10 * SLIVER)
    mine, other = (dict(zip(each.table("joint")["x"], each.table("joint")["pressure"])) for each in (run, twin))
    near("pressures before it", [mine[x] for x in sorted(mine) if x < 0.7], [other[x] for x in sorted(other) if x < 0.7], relative=10 * SLIVER)
