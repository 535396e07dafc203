"""The pair carries nothing, and both bodies hang and stand as each would alone: energies of the bodies in scenes of their own."""
from twins import judge_apart as judge  # noqa: F401  pylint: disable=unused-import
