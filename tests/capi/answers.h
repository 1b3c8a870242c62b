// What a localizer says of a frame, to the last byte.
#pragma once
#include <cstring>
#include <vector>

#include "spherecloud/spherecloud.hpp"
#include "tests/support/session.h"

namespace sphc::test {

inline std::vector<sphc_localizer_observation> observationsOf(Session *session) {
  uint32_t count = 0;
  sphc_localizer_observations(session->localizer(), nullptr, sizeof(sphc_localizer_observation), 0, &count);
  std::vector<sphc_localizer_observation> observations(count);
  sphc_localizer_observations(session->localizer(), observations.data(), sizeof(sphc_localizer_observation), count,
                              &count);
  return observations;
}

struct Answer {
  sphc_status status = SPHC_OK;
  sphc_localizer_result result = spherecloud::emptyResult();
  std::vector<sphc_localizer_observation> observations;

  bool operator==(const Answer &other) const {
    return status == other.status && std::memcmp(&result, &other.result, sizeof result) == 0 &&
           observations.size() == other.observations.size() &&
           (observations.empty() || std::memcmp(observations.data(), other.observations.data(),
                                                observations.size() * sizeof observations[0]) == 0);
  }
};

// `call(localizer, &result)` processes a frame, or locates it.
template <typename Call>
Answer answerOf(Session *session, const Call &call) {
  Answer answer;
  answer.status = call(session->localizer(), &answer.result);
  answer.observations = observationsOf(session);
  return answer;
}

}  // namespace sphc::test
