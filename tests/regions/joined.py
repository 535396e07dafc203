"""Groups that are joined by + form the body; regions are found among them. "upper two" holds the cells of "stiff layer" and "rest"."""
from layers import PLANE, check_fields, check_summary


def judge(run):
    check_summary(run, PLANE)
    check_fields(run, PLANE, 2)
