// Whether this host's network knows a way to a multicast group.
#pragma once

#include <string>

namespace arcstart {

// What the kernel says; LCM's own answer would fill a page. True also where the group is no IPv4
// address, of which LCM tells.
bool has_multicast_route(const std::string& group, int port);

}  // namespace arcstart
