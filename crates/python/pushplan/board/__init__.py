"""Board of tool tasks."""
