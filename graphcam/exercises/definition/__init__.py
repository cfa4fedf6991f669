"""What an exercise is: its file, its variants, the answers asked, and the mistakes that it can tell."""
