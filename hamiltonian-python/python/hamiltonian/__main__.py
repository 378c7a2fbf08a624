"""``python -m hamiltonian FILE``: the command ``hamiltonian-run``, see the chapter "From a file"."""

import signal
import sys

from ._hamiltonian import command


def main() -> None:
    """Runs the command with the arguments of the program."""
    # Ctrl-C ends the program: nothing here would raise `KeyboardInterrupt`.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    sys.exit(command(sys.argv[1:]))


if __name__ == "__main__":
    main()
