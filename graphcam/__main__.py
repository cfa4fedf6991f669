"""``python -m graphcam`` is ``graphcam``."""

from graphcam.cli import main

if __name__ == "__main__":
    main()
