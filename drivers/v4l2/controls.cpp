#include "controls.h"

#include <linux/videodev2.h>

#include <cctype>
#include <cerrno>
#include <cstdio>

#include "drivers/pixels/explain.h"

namespace sphc::v4l2 {

namespace {

using pixels::explain;

constexpr uint32_t kMaxControls = 512;
constexpr uint32_t kMaxNews = 64;
constexpr int64_t kMaxExposureUs = 1000000;

bool isNumber(uint32_t type) {
  return type == V4L2_CTRL_TYPE_INTEGER || type == V4L2_CTRL_TYPE_BOOLEAN || type == V4L2_CTRL_TYPE_MENU ||
         type == V4L2_CTRL_TYPE_INTEGER_MENU || type == V4L2_CTRL_TYPE_BITMASK || type == V4L2_CTRL_TYPE_INTEGER64;
}

sphc_v4l2_control describe(const v4l2_query_ext_ctrl &reply) {
  sphc_v4l2_control control = {};
  control.id = reply.id;
  std::snprintf(control.name, sizeof control.name, "%.32s", reply.name);
  control.minimum = reply.minimum;
  control.maximum = reply.maximum;
  control.step = reply.step ? static_cast<int64_t>(reply.step) : 1;
  control.default_value = reply.default_value;
  control.is_read_only = (reply.flags & V4L2_CTRL_FLAG_READ_ONLY) != 0;
  control.is_inactive = (reply.flags & (V4L2_CTRL_FLAG_INACTIVE | V4L2_CTRL_FLAG_GRABBED)) != 0;
  return control;
}

// Shows each usable control until `visit` says true.
template <typename Visit>
sphc_status forEachControl(const Node &node, sphc_message *message, Visit visit) {
  v4l2_query_ext_ctrl query = {};
  for (uint32_t i = 0; i < kMaxControls; ++i) {
    const uint32_t last_id = query.id;
    query = {};
    query.id = last_id | V4L2_CTRL_FLAG_NEXT_CTRL;
    const int error = node.ioctl(VIDIOC_QUERY_EXT_CTRL, &query);
    if (error == EINVAL || error == ENOTTY) return SPHC_OK;  // the end, or none at all
    if (error) return node.explain(message, "VIDIOC_QUERY_EXT_CTRL", error);
    if (isNumber(query.type) && !(query.flags & V4L2_CTRL_FLAG_DISABLED) && visit(describe(query))) return SPHC_OK;
  }
  return SPHC_OK;
}

bool isLetter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

// Letters and digits alone count, in any case.
bool sameName(const char *a, const char *b) {
  for (;;) {
    while (*a && !isLetter(*a)) ++a;
    while (*b && !isLetter(*b)) ++b;
    if (!*a || !*b) return *a == *b;
    if (std::tolower(static_cast<unsigned char>(*a++)) != std::tolower(static_cast<unsigned char>(*b++)))
      return false;
  }
}

sphc_status explainControl(const Node &node, const char *call, uint32_t id, int error, sphc_message *message) {
  if (error == EINVAL || error == ENOTTY)
    return explain(message, SPHC_E_UNSUPPORTED,
                   "%s has no control 0x%08x; sphc_v4l2_list_controls names those it has", node.path(), id);
  return node.explain(message, call, error);
}

int readValue(const Node &node, uint32_t id, int64_t *value) {
  v4l2_ext_control control = {};
  control.id = id;
  v4l2_ext_controls controls = {};
  controls.which = V4L2_CTRL_WHICH_CUR_VAL;
  controls.count = 1;
  controls.controls = &control;
  if (const int error = node.ioctl(VIDIOC_G_EXT_CTRLS, &controls)) return error;
  *value = control.value64;
  return 0;
}

int readDescription(const Node &node, uint32_t id, v4l2_query_ext_ctrl *reply) {
  *reply = {};
  reply->id = id;
  return node.ioctl(VIDIOC_QUERY_EXT_CTRL, reply);
}

sphc_status explainPayload(const Node &node, const v4l2_query_ext_ctrl &reply, sphc_message *message) {
  return explain(message, SPHC_E_UNSUPPORTED, "%s: %.32s is a text or a list, not one number; set it with v4l2-ctl",
                 node.path(), reply.name);
}

sphc_status checkSetting(const Node &node, const sphc_v4l2_control &control, int64_t value, sphc_message *message) {
  if (control.is_read_only)
    return explain(message, SPHC_E_UNSUPPORTED, "%s: %s is read only; leave it", node.path(), control.name);
  if (control.is_inactive)
    return explain(message, SPHC_E_STATE, "%s: %s is overruled by another control now; switch the automatic off",
                   node.path(), control.name);
  const uint64_t above = static_cast<uint64_t>(value) - static_cast<uint64_t>(control.minimum);
  if (value >= control.minimum && value <= control.maximum && above % static_cast<uint64_t>(control.step) == 0)
    return SPHC_OK;
  return explain(message, SPHC_E_ARGUMENT, "%s: %s is %lld; must be %lld to %lld in steps of %lld", node.path(),
                 control.name, static_cast<long long>(value), static_cast<long long>(control.minimum),
                 static_cast<long long>(control.maximum), static_cast<long long>(control.step));
}

void subscribe(const Node &node, uint32_t type, uint32_t id) {
  v4l2_event_subscription subscription = {};
  subscription.type = type;
  subscription.id = id;
  subscription.flags = V4L2_EVENT_SUB_FL_ALLOW_FEEDBACK;  // of our own settings too
  node.ioctl(VIDIOC_SUBSCRIBE_EVENT, &subscription);
}

}  // namespace

sphc_status listControls(const Node &node, sphc_v4l2_control *controls, uint32_t capacity, uint32_t *count,
                         sphc_message *message) {
  uint32_t found = 0;
  const sphc_status status = forEachControl(node, message, [&](const sphc_v4l2_control &control) {
    if (found < capacity) controls[found] = control;
    ++found;
    return false;
  });
  if (status == SPHC_OK) *count = found;
  return status;
}

sphc_status findControl(const Node &node, const char *name, sphc_v4l2_control *control, sphc_message *message) {
  bool found = false;
  const sphc_status status = forEachControl(node, message, [&](const sphc_v4l2_control &each) {
    found = sameName(each.name, name);
    if (found) *control = each;
    return found;
  });
  if (status < 0 || found) return status;
  return explain(message, SPHC_E_UNSUPPORTED,
                 "%s has no control named %.40s; sphc_v4l2_list_controls names those it has", node.path(), name);
}

sphc_status getControl(const Node &node, uint32_t id, int64_t *value, sphc_message *message) {
  v4l2_query_ext_ctrl reply;
  if (const int error = readDescription(node, id, &reply))
    return explainControl(node, "VIDIOC_QUERY_EXT_CTRL", id, error, message);
  if (reply.flags & V4L2_CTRL_FLAG_HAS_PAYLOAD) return explainPayload(node, reply, message);
  if (reply.flags & V4L2_CTRL_FLAG_WRITE_ONLY)
    return explain(message, SPHC_E_UNSUPPORTED, "%s: %.32s can only be set; remember what it was set to",
                   node.path(), reply.name);
  int64_t read = 0;
  if (const int error = readValue(node, id, &read))
    return explainControl(node, "VIDIOC_G_EXT_CTRLS", id, error, message);
  *value = reply.type == V4L2_CTRL_TYPE_INTEGER64 ? read : static_cast<int32_t>(read);
  return SPHC_OK;
}

sphc_status setControl(const Node &node, uint32_t id, int64_t value, sphc_message *message) {
  v4l2_query_ext_ctrl reply;
  if (const int error = readDescription(node, id, &reply))
    return explainControl(node, "VIDIOC_QUERY_EXT_CTRL", id, error, message);
  if (reply.flags & V4L2_CTRL_FLAG_HAS_PAYLOAD) return explainPayload(node, reply, message);
  const sphc_status status = checkSetting(node, describe(reply), value, message);
  if (status < 0) return status;
  v4l2_ext_control control = {};
  control.id = id;
  if (reply.type == V4L2_CTRL_TYPE_INTEGER64)
    control.value64 = value;
  else
    control.value = static_cast<int32_t>(value);
  v4l2_ext_controls controls = {};
  controls.which = V4L2_CTRL_WHICH_CUR_VAL;
  controls.count = 1;
  controls.controls = &control;
  const int error = node.ioctl(VIDIOC_S_EXT_CTRLS, &controls);
  if (error == EINVAL || error == ERANGE)  // the control is there, and the value in its range
    return explain(message, SPHC_E_ARGUMENT,
                   "%s: %.32s does not take %lld; v4l2-ctl --list-ctrls-menus has its choices", node.path(),
                   reply.name, static_cast<long long>(value));
  return error ? explainControl(node, "VIDIOC_S_EXT_CTRLS", id, error, message) : SPHC_OK;
}

uint32_t readExposureUs(const Node &node) {
  int64_t automatic = 0, hundreds_us = 0;
  const int error = readValue(node, V4L2_CID_EXPOSURE_AUTO, &automatic);
  if (error && error != EINVAL) return 0;  // it has the control, but does not say
  if (error == 0) {
    const int32_t choice = static_cast<int32_t>(automatic);
    if (choice != V4L2_EXPOSURE_MANUAL && choice != V4L2_EXPOSURE_SHUTTER_PRIORITY) return 0;
  }
  if (readValue(node, V4L2_CID_EXPOSURE_ABSOLUTE, &hundreds_us) != 0) return 0;
  const int64_t exposure_us = int64_t{static_cast<int32_t>(hundreds_us)} * 100;
  return exposure_us > 0 && exposure_us <= kMaxExposureUs ? static_cast<uint32_t>(exposure_us) : 0;
}

void subscribeEvents(const Node &node) {
  subscribe(node, V4L2_EVENT_CTRL, V4L2_CID_EXPOSURE_AUTO);
  subscribe(node, V4L2_EVENT_CTRL, V4L2_CID_EXPOSURE_ABSOLUTE);
  subscribe(node, V4L2_EVENT_SOURCE_CHANGE, 0);
}

News readNews(const Node &node) {
  News news = {};
  for (uint32_t i = 0; i < kMaxNews; ++i) {
    v4l2_event event = {};
    const int error = node.ioctl(VIDIOC_DQEVENT, &event);
    if (error) {
      if (error == ENODEV) news.error = error;  // else there are no more
      break;
    }
    if (event.type == V4L2_EVENT_CTRL) news.exposure_changed = true;
    if (event.type == V4L2_EVENT_SOURCE_CHANGE && (event.u.src_change.changes & V4L2_EVENT_SRC_CH_RESOLUTION))
      news.source_changed = true;
  }
  return news;
}

}  // namespace sphc::v4l2
