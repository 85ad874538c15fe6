"""What goes wrong with a data set."""


class DatasetError(RuntimeError):
    """A data set that cannot be read. The message is one line: file, what is wrong, what was expected."""
