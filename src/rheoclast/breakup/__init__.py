"""Where fluid and structure meet: contact loads for every flow, and how the aggregate fails."""
