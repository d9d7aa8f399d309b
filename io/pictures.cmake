# nacre::io_pictures
