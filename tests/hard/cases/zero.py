"""Nothing moves, and nothing presses."""
from rest import judge  # noqa: F401  pylint: disable=unused-import
