/* Prints where each field of the door's structs lies: struct,field,offset,bytes. */
#include <spherecloud/spherecloud.h>
#include <stddef.h>
#include <stdio.h>

#define WHOLE(type) printf("%s,,,%lu\n", #type, (unsigned long)sizeof(type))
#define FIELD(type, field)                                                       \
  printf("%s,%s,%lu,%lu\n", #type, #field, (unsigned long)offsetof(type, field), \
         (unsigned long)sizeof(((type *)0)->field))

int main(void) {
  printf("struct,field,offset,bytes\n");
  WHOLE(sphc_message);
  FIELD(sphc_message, text);
  WHOLE(sphc_rigid);
  FIELD(sphc_rigid, q_wxyz);
  FIELD(sphc_rigid, t_m);
  WHOLE(sphc_camera);
  FIELD(sphc_camera, model);
  FIELD(sphc_camera, width);
  FIELD(sphc_camera, height);
  FIELD(sphc_camera, param_count);
  FIELD(sphc_camera, params);
  WHOLE(sphc_image);
  FIELD(sphc_image, data);
  FIELD(sphc_image, width);
  FIELD(sphc_image, height);
  FIELD(sphc_image, stride_bytes);
  FIELD(sphc_image, format);
  WHOLE(sphc_frame);
  FIELD(sphc_frame, struct_size);
  FIELD(sphc_frame, sequence);
  FIELD(sphc_frame, color_time_ns);
  FIELD(sphc_frame, depth_time_ns);
  FIELD(sphc_frame, color);
  FIELD(sphc_frame, depth);
  WHOLE(sphc_map_info);
  FIELD(sphc_map_info, struct_size);
  FIELD(sphc_map_info, format_version);
  FIELD(sphc_map_info, point_count);
  FIELD(sphc_map_info, extractor);
  FIELD(sphc_map_info, file_bytes);
  FIELD(sphc_map_info, map_id);
  WHOLE(sphc_config);
  FIELD(sphc_config, struct_size);
  FIELD(sphc_config, max_keypoints);
  FIELD(sphc_config, max_iterations);
  FIELD(sphc_config, max_ratio);
  FIELD(sphc_config, seed);
  FIELD(sphc_config, color_camera);
  FIELD(sphc_config, depth_camera);
  FIELD(sphc_config, color_from_depth);
  FIELD(sphc_config, depth_unit_m);
  FIELD(sphc_config, depth_min_m);
  FIELD(sphc_config, depth_max_m);
  FIELD(sphc_config, depth_sigma_m);
  FIELD(sphc_config, depth_sigma_per_m2);
  FIELD(sphc_config, pixel_sigma_px);
  FIELD(sphc_config, map_sigma_m);
  FIELD(sphc_config, min_inliers);
  FIELD(sphc_config, reserved);
  FIELD(sphc_config, log);
  FIELD(sphc_config, log_user);
  FIELD(sphc_config, clock);
  FIELD(sphc_config, clock_user);
  WHOLE(sphc_result);
  FIELD(sphc_result, struct_size);
  FIELD(sphc_result, sequence);
  FIELD(sphc_result, time_ns);
  FIELD(sphc_result, outcome);
  FIELD(sphc_result, keypoints);
  FIELD(sphc_result, lifted);
  FIELD(sphc_result, matches);
  FIELD(sphc_result, inliers);
  FIELD(sphc_result, iterations);
  FIELD(sphc_result, camera_from_map);
  FIELD(sphc_result, covariance);
  FIELD(sphc_result, features_us);
  FIELD(sphc_result, align_us);
  FIELD(sphc_result, match_us);
  FIELD(sphc_result, pose_us);
  WHOLE(sphc_memory);
  FIELD(sphc_memory, state_bytes);
  FIELD(sphc_memory, scratch_bytes);
  FIELD(sphc_memory, alignment);
  WHOLE(sphc_memory_piece);
  FIELD(sphc_memory_piece, name);
  FIELD(sphc_memory_piece, bytes);
  FIELD(sphc_memory_piece, scratch);
  FIELD(sphc_memory_piece, reserved);
  WHOLE(sphc_observation);
  FIELD(sphc_observation, x_px);
  FIELD(sphc_observation, y_px);
  FIELD(sphc_observation, scale_px);
  FIELD(sphc_observation, depth_m);
  FIELD(sphc_observation, map_index);
  FIELD(sphc_observation, flags);
  WHOLE(sphc_capture);
  FIELD(sphc_capture, struct_size);
  FIELD(sphc_capture, stream);
  FIELD(sphc_capture, time_ns);
  FIELD(sphc_capture, token);
  FIELD(sphc_capture, sequence);
  FIELD(sphc_capture, reserved);
  FIELD(sphc_capture, image);
  WHOLE(sphc_source);
  FIELD(sphc_source, struct_size);
  FIELD(sphc_source, loan_limit);
  FIELD(sphc_source, self);
  FIELD(sphc_source, start);
  FIELD(sphc_source, acquire);
  FIELD(sphc_source, release);
  FIELD(sphc_source, stop);
  FIELD(sphc_source, message);
  WHOLE(sphc_pairer_config);
  FIELD(sphc_pairer_config, struct_size);
  FIELD(sphc_pairer_config, slots);
  FIELD(sphc_pairer_config, tolerance_ns);
  WHOLE(sphc_pair);
  FIELD(sphc_pair, struct_size);
  FIELD(sphc_pair, reserved);
  FIELD(sphc_pair, color);
  FIELD(sphc_pair, depth);
  return 0;
}
