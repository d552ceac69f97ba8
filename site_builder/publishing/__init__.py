"""Files for search engines, feed readers, social networks and the host."""
