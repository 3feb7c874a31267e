"""The course of the example; nbgrader reads this file where it is run."""

c = get_config()  # type: ignore[name-defined]  # noqa: F821 -- nbgrader gives it
c.CourseDirectory.course_id = "pendulums"
