"""From a folder of hand-ins to one record each, whatever was handed in and whatever happens meanwhile."""
