"""A page for a class: thirty mistakes, a question before each."""
