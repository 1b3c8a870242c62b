// Constants of the C interface by their names.
#include "spherecloud/spherecloud_capture.h"

const char *sphc_format_name(sphc_format format) {
  switch (format) {
    case SPHC_FORMAT_GRAY8:
      return "SPHC_FORMAT_GRAY8";
    case SPHC_FORMAT_RGB8:
      return "SPHC_FORMAT_RGB8";
    case SPHC_FORMAT_BGR8:
      return "SPHC_FORMAT_BGR8";
    case SPHC_FORMAT_RGBA8:
      return "SPHC_FORMAT_RGBA8";
    case SPHC_FORMAT_BGRA8:
      return "SPHC_FORMAT_BGRA8";
    case SPHC_FORMAT_NV12:
      return "SPHC_FORMAT_NV12";
    case SPHC_FORMAT_I420:
      return "SPHC_FORMAT_I420";
    case SPHC_FORMAT_YUYV:
      return "SPHC_FORMAT_YUYV";
    case SPHC_FORMAT_UYVY:
      return "SPHC_FORMAT_UYVY";
    case SPHC_FORMAT_DEPTH16:
      return "SPHC_FORMAT_DEPTH16";
    case SPHC_FORMAT_DEPTH12P:
      return "SPHC_FORMAT_DEPTH12P";
    case SPHC_FORMAT_DEPTH_F32:
      return "SPHC_FORMAT_DEPTH_F32";
    case SPHC_FORMAT_RANGE16:
      return "SPHC_FORMAT_RANGE16";
    case SPHC_FORMAT_RANGE12P:
      return "SPHC_FORMAT_RANGE12P";
    case SPHC_FORMAT_RANGE_F32:
      return "SPHC_FORMAT_RANGE_F32";
    case SPHC_FORMAT_GRAY10:
      return "SPHC_FORMAT_GRAY10";
    case SPHC_FORMAT_GRAY12:
      return "SPHC_FORMAT_GRAY12";
    case SPHC_FORMAT_GRAY16:
      return "SPHC_FORMAT_GRAY16";
    case SPHC_FORMAT_GRAY10P:
      return "SPHC_FORMAT_GRAY10P";
    case SPHC_FORMAT_GRAY12P:
      return "SPHC_FORMAT_GRAY12P";
    case SPHC_FORMAT_BAYER_RGGB8:
      return "SPHC_FORMAT_BAYER_RGGB8";
    case SPHC_FORMAT_BAYER_GRBG8:
      return "SPHC_FORMAT_BAYER_GRBG8";
    case SPHC_FORMAT_BAYER_GBRG8:
      return "SPHC_FORMAT_BAYER_GBRG8";
    case SPHC_FORMAT_BAYER_BGGR8:
      return "SPHC_FORMAT_BAYER_BGGR8";
    case SPHC_FORMAT_BAYER_RGGB10:
      return "SPHC_FORMAT_BAYER_RGGB10";
    case SPHC_FORMAT_BAYER_GRBG10:
      return "SPHC_FORMAT_BAYER_GRBG10";
    case SPHC_FORMAT_BAYER_GBRG10:
      return "SPHC_FORMAT_BAYER_GBRG10";
    case SPHC_FORMAT_BAYER_BGGR10:
      return "SPHC_FORMAT_BAYER_BGGR10";
    case SPHC_FORMAT_BAYER_RGGB12:
      return "SPHC_FORMAT_BAYER_RGGB12";
    case SPHC_FORMAT_BAYER_GRBG12:
      return "SPHC_FORMAT_BAYER_GRBG12";
    case SPHC_FORMAT_BAYER_GBRG12:
      return "SPHC_FORMAT_BAYER_GBRG12";
    case SPHC_FORMAT_BAYER_BGGR12:
      return "SPHC_FORMAT_BAYER_BGGR12";
    case SPHC_FORMAT_BAYER_RGGB16:
      return "SPHC_FORMAT_BAYER_RGGB16";
    case SPHC_FORMAT_BAYER_GRBG16:
      return "SPHC_FORMAT_BAYER_GRBG16";
    case SPHC_FORMAT_BAYER_GBRG16:
      return "SPHC_FORMAT_BAYER_GBRG16";
    case SPHC_FORMAT_BAYER_BGGR16:
      return "SPHC_FORMAT_BAYER_BGGR16";
    case SPHC_FORMAT_BAYER_RGGB10P:
      return "SPHC_FORMAT_BAYER_RGGB10P";
    case SPHC_FORMAT_BAYER_GRBG10P:
      return "SPHC_FORMAT_BAYER_GRBG10P";
    case SPHC_FORMAT_BAYER_GBRG10P:
      return "SPHC_FORMAT_BAYER_GBRG10P";
    case SPHC_FORMAT_BAYER_BGGR10P:
      return "SPHC_FORMAT_BAYER_BGGR10P";
    case SPHC_FORMAT_BAYER_RGGB12P:
      return "SPHC_FORMAT_BAYER_RGGB12P";
    case SPHC_FORMAT_BAYER_GRBG12P:
      return "SPHC_FORMAT_BAYER_GRBG12P";
    case SPHC_FORMAT_BAYER_GBRG12P:
      return "SPHC_FORMAT_BAYER_GBRG12P";
    case SPHC_FORMAT_BAYER_BGGR12P:
      return "SPHC_FORMAT_BAYER_BGGR12P";
    default:
      return "SPHC_FORMAT_?";
  }
}

const char *sphc_camera_model_name(sphc_camera_model model) {
  switch (model) {
    case SPHC_CAMERA_PINHOLE:
      return "SPHC_CAMERA_PINHOLE";
    case SPHC_CAMERA_BROWN5:
      return "SPHC_CAMERA_BROWN5";
    case SPHC_CAMERA_BROWN8:
      return "SPHC_CAMERA_BROWN8";
    case SPHC_CAMERA_KANNALA_BRANDT4:
      return "SPHC_CAMERA_KANNALA_BRANDT4";
    default:
      return "SPHC_CAMERA_?";
  }
}

const char *sphc_band_name(sphc_band band) {
  switch (band) {
    case SPHC_BAND_VISIBLE:
      return "SPHC_BAND_VISIBLE";
    case SPHC_BAND_INFRARED:
      return "SPHC_BAND_INFRARED";
    default:
      return "SPHC_BAND_?";
  }
}

const char *sphc_convention_name(sphc_convention convention) {
  switch (convention) {
    case SPHC_CONVENTION_OPENXR:
      return "SPHC_CONVENTION_OPENXR";
    case SPHC_CONVENTION_UNITY:
      return "SPHC_CONVENTION_UNITY";
    case SPHC_CONVENTION_ROS_OPTICAL:
      return "SPHC_CONVENTION_ROS_OPTICAL";
    case SPHC_CONVENTION_ROS_FLU:
      return "SPHC_CONVENTION_ROS_FLU";
    case SPHC_CONVENTION_COLMAP:
      return "SPHC_CONVENTION_COLMAP";
    case SPHC_CONVENTION_TUM:
      return "SPHC_CONVENTION_TUM";
    default:
      return "SPHC_CONVENTION_?";
  }
}

const char *sphc_aligned_pixel_name(sphc_aligned_pixel pixel) {
  switch (pixel) {
    case SPHC_ALIGNED_HOLE:
      return "SPHC_ALIGNED_HOLE";
    case SPHC_ALIGNED_MEASURED:
      return "SPHC_ALIGNED_MEASURED";
    case SPHC_ALIGNED_FILLED:
      return "SPHC_ALIGNED_FILLED";
    case SPHC_ALIGNED_OCCLUDED:
      return "SPHC_ALIGNED_OCCLUDED";
    default:
      return "SPHC_ALIGNED_?";
  }
}

const char *sphc_log_level_name(sphc_log_level level) {
  switch (level) {
    case SPHC_LOG_ERROR:
      return "SPHC_LOG_ERROR";
    case SPHC_LOG_WARNING:
      return "SPHC_LOG_WARNING";
    case SPHC_LOG_INFO:
      return "SPHC_LOG_INFO";
    case SPHC_LOG_DEBUG:
      return "SPHC_LOG_DEBUG";
    default:
      return "SPHC_LOG_?";
  }
}

const char *sphc_localizer_mode_name(sphc_localizer_mode mode) {
  switch (mode) {
    case SPHC_MODE_TRACKING:
      return "SPHC_MODE_TRACKING";
    case SPHC_MODE_SINGLE:
      return "SPHC_MODE_SINGLE";
    default:
      return "SPHC_MODE_?";
  }
}

const char *sphc_localizer_state_name(sphc_localizer_state state) {
  switch (state) {
    case SPHC_STATE_RELOCALIZING:
      return "SPHC_STATE_RELOCALIZING";
    case SPHC_STATE_TRACKING:
      return "SPHC_STATE_TRACKING";
    case SPHC_STATE_LOST:
      return "SPHC_STATE_LOST";
    default:
      return "SPHC_STATE_?";
  }
}

const char *sphc_localizer_outcome_name(sphc_localizer_outcome outcome) {
  switch (outcome) {
    case SPHC_OUTCOME_LOCALIZED:
      return "SPHC_OUTCOME_LOCALIZED";
    case SPHC_OUTCOME_FEW_KEYPOINTS:
      return "SPHC_OUTCOME_FEW_KEYPOINTS";
    case SPHC_OUTCOME_FEW_DEPTHS:
      return "SPHC_OUTCOME_FEW_DEPTHS";
    case SPHC_OUTCOME_FEW_MATCHES:
      return "SPHC_OUTCOME_FEW_MATCHES";
    case SPHC_OUTCOME_NO_CONSENSUS:
      return "SPHC_OUTCOME_NO_CONSENSUS";
    case SPHC_OUTCOME_UNCERTAIN:
      return "SPHC_OUTCOME_UNCERTAIN";
    case SPHC_OUTCOME_DEADLINE:
      return "SPHC_OUTCOME_DEADLINE";
    case SPHC_OUTCOME_CONTRADICTION:
      return "SPHC_OUTCOME_CONTRADICTION";
    default:
      return "SPHC_OUTCOME_?";
  }
}

const char *sphc_localizer_fault_name(uint32_t fault) {
  switch (fault) {
    case SPHC_FAULT_DEPTH_RANGE:
      return "SPHC_FAULT_DEPTH_RANGE";
    case SPHC_FAULT_DEPTH_CONSTANT:
      return "SPHC_FAULT_DEPTH_CONSTANT";
    case SPHC_FAULT_DEPTH_BENT:
      return "SPHC_FAULT_DEPTH_BENT";
    case SPHC_FAULT_DEPTH_FROZEN:
      return "SPHC_FAULT_DEPTH_FROZEN";
    case SPHC_FAULT_COLOR_FROZEN:
      return "SPHC_FAULT_COLOR_FROZEN";
    case SPHC_FAULT_DEPTH_COLOR_DISAGREE:
      return "SPHC_FAULT_DEPTH_COLOR_DISAGREE";
    case SPHC_FAULT_DEPTH_SCALE:
      return "SPHC_FAULT_DEPTH_SCALE";
    case SPHC_FAULT_DEPTH_BIAS:
      return "SPHC_FAULT_DEPTH_BIAS";
    case SPHC_FAULT_VERTICAL_DISAGREES:
      return "SPHC_FAULT_VERTICAL_DISAGREES";
    case SPHC_FAULT_MIRRORED:
      return "SPHC_FAULT_MIRRORED";
    case SPHC_FAULT_DISTANCES_DISAGREE:
      return "SPHC_FAULT_DISTANCES_DISAGREE";
    case SPHC_FAULT_ODOMETRY_DISAGREES:
      return "SPHC_FAULT_ODOMETRY_DISAGREES";
    case SPHC_FAULT_FOCAL_DISAGREES:
      return "SPHC_FAULT_FOCAL_DISAGREES";
    default:
      return "SPHC_FAULT_?";
  }
}

const char *sphc_localizer_cut_name(uint32_t cut) {
  switch (cut) {
    case SPHC_CUT_FEATURES:
      return "SPHC_CUT_FEATURES";
    case SPHC_CUT_MATCHES:
      return "SPHC_CUT_MATCHES";
    case SPHC_CUT_SEARCH:
      return "SPHC_CUT_SEARCH";
    case SPHC_CUT_VERIFICATION:
      return "SPHC_CUT_VERIFICATION";
    default:
      return "SPHC_CUT_?";
  }
}

const char *sphc_localizer_hint_name(uint32_t hint) {
  switch (hint) {
    case SPHC_HINT_TOO_DARK:
      return "SPHC_HINT_TOO_DARK";
    case SPHC_HINT_TOO_FAST:
      return "SPHC_HINT_TOO_FAST";
    case SPHC_HINT_TOO_PLAIN:
      return "SPHC_HINT_TOO_PLAIN";
    case SPHC_HINT_NO_DEPTH_IN_RANGE:
      return "SPHC_HINT_NO_DEPTH_IN_RANGE";
    case SPHC_HINT_NOT_IN_MAP:
      return "SPHC_HINT_NOT_IN_MAP";
    case SPHC_HINT_AMBIGUOUS:
      return "SPHC_HINT_AMBIGUOUS";
    default:
      return "SPHC_HINT_?";
  }
}

const char *sphc_localizer_event_name(uint32_t event) {
  switch (event) {
    case SPHC_EVENT_RELOCALIZED:
      return "SPHC_EVENT_RELOCALIZED";
    case SPHC_EVENT_JUMPED:
      return "SPHC_EVENT_JUMPED";
    case SPHC_EVENT_MAP_CHANGED:
      return "SPHC_EVENT_MAP_CHANGED";
    default:
      return "SPHC_EVENT_?";
  }
}

const char *sphc_localizer_parameter_name(sphc_localizer_parameter parameter) {
  switch (parameter) {
    case SPHC_PARAMETER_MAX_RATIO:
      return "SPHC_PARAMETER_MAX_RATIO";
    case SPHC_PARAMETER_PROBES:
      return "SPHC_PARAMETER_PROBES";
    case SPHC_PARAMETER_MAX_ITERATIONS:
      return "SPHC_PARAMETER_MAX_ITERATIONS";
    case SPHC_PARAMETER_MIN_INLIERS:
      return "SPHC_PARAMETER_MIN_INLIERS";
    default:
      return "SPHC_PARAMETER_?";
  }
}

const char *sphc_stream_name(sphc_stream stream) {
  switch (stream) {
    case SPHC_STREAM_NONE:
      return "SPHC_STREAM_NONE";
    case SPHC_STREAM_COLOR:
      return "SPHC_STREAM_COLOR";
    case SPHC_STREAM_DEPTH:
      return "SPHC_STREAM_DEPTH";
    default:
      return "SPHC_STREAM_?";
  }
}

const char *sphc_clock_id_name(sphc_clock_id clock) {
  switch (clock) {
    case SPHC_CLOCK_SOURCE:
      return "SPHC_CLOCK_SOURCE";
    case SPHC_CLOCK_MONOTONIC:
      return "SPHC_CLOCK_MONOTONIC";
    case SPHC_CLOCK_BOOTTIME:
      return "SPHC_CLOCK_BOOTTIME";
    default:
      return "SPHC_CLOCK_?";
  }
}

const char *sphc_time_point_name(sphc_time_point point) {
  switch (point) {
    case SPHC_TIME_MIDDLE:
      return "SPHC_TIME_MIDDLE";
    case SPHC_TIME_START:
      return "SPHC_TIME_START";
    case SPHC_TIME_END:
      return "SPHC_TIME_END";
    case SPHC_TIME_ARRIVAL:
      return "SPHC_TIME_ARRIVAL";
    default:
      return "SPHC_TIME_?";
  }
}

const char *sphc_pairer_drop_name(sphc_pairer_drop drop) {
  switch (drop) {
    case SPHC_DROP_NONE:
      return "SPHC_DROP_NONE";
    case SPHC_DROP_TOO_FAR:
      return "SPHC_DROP_TOO_FAR";
    case SPHC_DROP_OVERTAKEN:
      return "SPHC_DROP_OVERTAKEN";
    case SPHC_DROP_FULL:
      return "SPHC_DROP_FULL";
    case SPHC_DROP_ENDED:
      return "SPHC_DROP_ENDED";
    default:
      return "SPHC_DROP_?";
  }
}
