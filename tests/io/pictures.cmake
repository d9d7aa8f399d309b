# Tests of nacre::io_pictures.
