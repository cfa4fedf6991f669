"""The module that hides Unix is for processes of their own."""

collect_ignore = ["hidden"]
