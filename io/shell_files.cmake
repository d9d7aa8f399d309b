# nacre::io_shell_files
