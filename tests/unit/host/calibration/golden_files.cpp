#include "golden_files.h"

namespace sphc::host {

const char *const kKalibrFile = R"(cam0:
  camera_model: pinhole
  intrinsics: [461.629, 460.152, 362.680, 246.049]
  distortion_model: radtan
  distortion_coeffs: [-0.27695497, 0.06712482, 0.00087538, 0.00011556]
  rostopic: /cam0/image_raw
  resolution: [752, 480]
cam1:
  camera_model: pinhole
  intrinsics: [458.655, 457.296, 367.215, 248.375]
  distortion_model: equidistant
  distortion_coeffs: [-0.01353, 0.05274, -0.04979, 0.01355]
  T_cn_cnm1:
  - [0.0, -1.0, 0.0, -0.11]
  - [1.0, 0.0, 0.0, 0.02]
  - [0.0, 0.0, 1.0, 0.003]
  - [0.0, 0.0, 0.0, 1.0]
  rostopic: /cam1/image_raw
  resolution: [640, 480]
)";

const char *const kRosColorFile = R"(image_width: 640
image_height: 480
camera_name: narrow_stereo
camera_matrix:
  rows: 3
  cols: 3
  data: [438.783367, 0.000000, 305.593336, 0.000000, 437.302876, 243.738352, 0.000000, 0.000000, 1.000000]
distortion_model: plumb_bob
distortion_coefficients:
  rows: 1
  cols: 5
  data: [-0.361976, 0.110510, 0.001014, 0.000505, 0.000000]
rectification_matrix:
  rows: 3
  cols: 3
  data: [1, 0, 0, 0, 1, 0, 0, 0, 1]
projection_matrix:
  rows: 3
  cols: 4
  data: [393.65, 0, 322.79, 0, 0, 393.65, 241.09, 0, 0, 0, 1, 0]
)";

const char *const kRosDepthFile = R"(image_width: 320
image_height: 288
camera_name: tof
camera_matrix: {rows: 3, cols: 3, data: [252.1, 0, 160.2, 0, 252.3, 140.4, 0, 0, 1]}
distortion_model: rational_polynomial
distortion_coefficients: {rows: 1, cols: 8, data: [0.5, -2.6, 0.0008, -0.0003, 1.49, 0.38, -2.44, 1.42]}
)";

const char *const kOpencvSampleFile = R"(%YAML:1.0
---
calibration_time: "Fri 21 Nov 2025"
image_width: 640
image_height: 480
board_width: 9
camera_matrix: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 5.3591573396163199e+02, 0., 3.4228315473308373e+02, 0.,
       5.3591573396163199e+02, 2.3557082909788173e+02, 0., 0., 1. ]
distortion_coefficients: !!opencv-matrix
   rows: 5
   cols: 1
   dt: d
   data: [ -2.6637260909660682e-01, -3.8588898922304653e-02,
       1.7831947042852964e-03, -2.8122100441115472e-04,
       2.3839153080878486e-01 ]
)";

const char *const kOpencvStereoFile = R"(%YAML:1.0
---
image_width: 640
image_height: 480
M1: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 534., 0., 341.5, 0., 533., 234.25, 0., 0., 1. ]
D1: !!opencv-matrix
   rows: 1
   cols: 14
   dt: d
   data: [ -0.29, 0.10, 0.001, -0.002, 0.01, 0.03, 0.02, 0.01, 0., 0., 0., 0., 0., 0. ]
M2: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 532., 0., 327.25, 0., 531., 249.75, 0., 0., 1. ]
D2: !!opencv-matrix
   rows: 1
   cols: 4
   dt: d
   data: [ 0., 0., 0., 0. ]
R: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 1., 0., 0., 0., 0., -1., 0., 1., 0. ]
T: !!opencv-matrix
   rows: 3
   cols: 1
   dt: d
   data: [ -0.25, 0.5, 0.125 ]
)";

const char *const kColmapCamerasFile = R"(# Camera list with one line of data per camera:
#   CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]
# Number of cameras: 2
1 SIMPLE_RADIAL 3072 2304 2559.69 1536 1152 -0.0218531
2 OPENCV 640 480 525.5 524.5 319.5 239.5 0.1 -0.2 0.001 0.002
)";

const char *const kColmapRigsFile = R"(# Rig calib list with one line of data per calib:
#   RIG_ID, NUM_SENSORS, REF_SENSOR_TYPE, REF_SENSOR_ID, SENSORS[] as (SENSOR_TYPE, SENSOR_ID, HAS_POSE, [QW, QX, QY, QZ, TX, TY, TZ])
# Number of rigs: 1
1 2 CAMERA 1 CAMERA 2 1 0.8 0.6 0 0 -0.19 0.0008 0.0070
)";

const char *const kAzureKinectFile = R"({"CalibrationInformation": {"Cameras": [
{"Intrinsics": {"ModelParameterCount": 14,
  "ModelParameters": [0.51, 0.49, 0.4925, 0.4926, 0.5, -2.6, 1.49, 0.38, -2.44, 1.42, 0.0, 0.0, -2.5e-5, 3.0e-5],
  "ModelType": "CALIBRATION_LensDistortionModelBrownConrady"},
 "Location": "CALIBRATION_CameraLocationD0", "Purpose": "CALIBRATION_CameraPurposeDepth", "MetricRadius": 1.74,
 "Rt": {"Rotation": [1, 0, 0, 0, 1, 0, 0, 0, 1], "Translation": [0, 0, 0]},
 "SensorHeight": 1024, "SensorWidth": 1024},
{"Intrinsics": {"ModelParameterCount": 14,
  "ModelParameters": [0.5, 0.48, 0.6, 0.8, 0.6, -2.7, 1.6, 0.48, -2.5, 1.5, 0.0, 0.0, -0.0004, -0.0001],
  "ModelType": "CALIBRATION_LensDistortionModelBrownConrady"},
 "Location": "CALIBRATION_CameraLocationPV0", "Purpose": "CALIBRATION_CameraPurposePhotoVideo", "MetricRadius": 1.7,
 "Rt": {"Rotation": [1, 0, 0, 0, 0.8, 0.6, 0, -0.6, 0.8], "Translation": [-0.032, -0.002, 0.004]},
 "SensorHeight": 3072, "SensorWidth": 4096}],
"InertialSensors": []}})";

}  // namespace sphc::host
