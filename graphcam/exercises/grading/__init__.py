"""From a folder of submissions to one record each, whatever was handed in and whatever happens meanwhile."""
