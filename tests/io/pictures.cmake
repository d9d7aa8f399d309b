nacre_test(io_pictures
  SOURCES picture_file_test.cpp
  LINK nacre::io_pictures ZLIB::ZLIB)
