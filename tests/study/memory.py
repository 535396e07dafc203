"""A run that is expected to need too much memory is omitted, and all larger ones. The study ends with exit code 0."""
from judge import require, same
from studies import block, rows


def judge(run):
    table = rows(run)
    limit = float(run.arguments[run.arguments.index("-study_memory") + 1].rstrip("M")) * 2**20
    same("rows", len(table), 10)
    for row, told in zip(table, block(run)["runs"]):
        same("status in the summary", told["status"], row["status"])
        if row["status"] == "skipped":
            require("-study_memory" in row["reason"] and row["peak_bytes_forecast"] > limit, f"left out without reason: {row}")
            require(row["iterations"] != row["iterations"] and told["iterations"] is None, "a run that was left out took steps")
        else:
            require(row["peak_bytes"] < 1.1 * limit, f"{row['peak_bytes']:g} bytes were taken")
            if row["unknowns"] > 3000:
                require(0.7 < row["peak_bytes_forecast"] / row["peak_bytes"] < 1.7, f"expected {row['peak_bytes_forecast']:g} bytes, took {row['peak_bytes']:g}")
    skipped = [row["status"] == "skipped" for row in table]
    require(not any(skipped[:4]) and all(skipped[-2:]), f"left out were {skipped}")
    same("lines on the terminal", run.stdout.count("skipped: would need about"), sum(skipped))
