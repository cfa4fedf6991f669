"""What every notebook that graphcam writes says of itself."""

PYTHON = {"kernelspec": {"name": "python3", "display_name": "Python 3"}, "language_info": {"name": "python"}}
"""Metadata of a notebook whose code is Python."""
