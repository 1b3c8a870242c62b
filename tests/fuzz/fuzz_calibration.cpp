#include <cstring>

#include "host/recording/calibration.h"
#include "tests/fuzz/targets.h"

namespace sphc::fuzz {

void calibration(const uint8_t *data, size_t bytes) {
  sphc_rig parsed;
  sphc_rig_init(&parsed);
  const sphc_rig before = parsed;
  sphc_message message = {};
  const std::vector<char> text(data, data + bytes);  // exactly sized, not terminated
  const sphc_status status = sphc_calibration_parse(text.data(), text.size(), "fuzz.json", &parsed, &message);
  if (status == SPHC_OK) {
    accept();
    if (sphc_rig_check(&parsed, &message) != SPHC_OK) broken("what is read passes the check");
  } else {
    if (status > 0 || !message.text[0]) broken("a refusal is a failure that explains itself");
    if (std::memcmp(&parsed, &before, sizeof parsed) != 0) broken("failure leaves the output untouched");
  }
}

}  // namespace sphc::fuzz
