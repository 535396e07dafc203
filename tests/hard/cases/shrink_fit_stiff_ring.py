from lame import judge_force as judge  # noqa: F401  pylint: disable=unused-import
