"""Files: texts read, results written whole, and which files a text imports."""
