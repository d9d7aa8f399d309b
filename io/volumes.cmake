# nacre::io_volumes
