# Tests of nacre::io_volumes.
nacre_test(io_volumes
  SOURCES real_volumes_test.cpp
  LINK nacre::io_volumes)
