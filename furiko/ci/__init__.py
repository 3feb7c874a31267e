"""furiko in other projects' CI: the script ``furiko-ci``, a GitLab job, and what the script leaves in its folder.

May import everything else of the package but the command line.
"""
