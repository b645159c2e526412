"""What goes wrong, told to a person: what, where, and how to mend it."""


class Error(Exception):
    """The base of all that lutka raises of its own.

    `message` says what is wrong, `location` where (a file and the place in it, or the call), `mend` what can be done about
    it; the last two may be empty.
    """

    def __init__(self, message, location="", mend=""):
        super().__init__(message, location, mend)
        self.message = message
        self.location = location
        self.mend = mend

    def __str__(self):
        text = f"{self.location}: {self.message}" if self.location else self.message
        return f"{text} ({self.mend})" if self.mend else text


class UsageError(Error, ValueError):
    """What was asked for does not exist or does not fit together."""


class InputError(Error):
    """A file can't be read or isn't usable."""


class OutputError(Error):
    """A file can't be written."""


class InternalError(Error):
    """A defect of lutka, or of a library beneath it."""
