// A build without the page.
#include "viewer/page.h"

namespace nacre {

std::string viewer_page() { return {}; }

}  // namespace nacre
