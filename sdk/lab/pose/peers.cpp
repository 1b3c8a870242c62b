#include "lab/pose/peers.h"

namespace sphc::host {

std::vector<PoseVariant> posePeers(const std::string &python) {
  std::vector<PoseVariant> peers = {poseLibPeer(python), openCvPeer()};
  for (PoseVariant &peer : openGvPeers()) peers.push_back(std::move(peer));
  return peers;
}

}  // namespace sphc::host
