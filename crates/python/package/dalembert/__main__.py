"""The command: ``python -m dalembert generate panda.toml``."""

import signal
import sys

from ._dalembert import command

# The command has no code of Python's that would look for a Ctrl-C.
signal.signal(signal.SIGINT, signal.SIG_DFL)
sys.exit(command(["dalembert", *sys.argv[1:]]))
