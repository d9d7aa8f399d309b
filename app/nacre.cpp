#include "app/command.h"

int main(int argc, char** argv) { return nacre::run_nacre(argc, argv); }
