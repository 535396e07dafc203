from bars import judge  # noqa: F401  pylint: disable=unused-import
