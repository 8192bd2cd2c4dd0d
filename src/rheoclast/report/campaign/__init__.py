"""The page on a campaign: what `rheoclast survey` left in a folder, by kinds of aggregates.

What the files hold is read in `folder`, sorted by what it belongs to in `kinds`, and told in `tables`, `charts` and
`summary`. All is counted and averaged here, so that a page on a million events is no larger than one on a hundred.
"""
