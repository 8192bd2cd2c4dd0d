"""`python -m rheoclast` is the command line."""

from rheoclast.cli import main

if __name__ == "__main__":
    main()
