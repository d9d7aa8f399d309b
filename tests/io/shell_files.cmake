# Tests of nacre::io_shell_files.
