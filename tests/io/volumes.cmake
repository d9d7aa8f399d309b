# Tests of nacre::io_volumes.
