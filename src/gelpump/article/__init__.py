"""The replication article: the content of a build, told in sentences and typeset as a PDF."""
