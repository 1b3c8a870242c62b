//! What comes out of a localizer.
use core::mem::zeroed;

use spherecloud_sys as sys;

use crate::geometry::same_layout;
use crate::{Cuts, Events, Faults, Hints, ObservationFlags, Outcome, Rigid, State};

/// What became of a frame.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Localization {
    /// Of the frame.
    pub sequence: u32,
    /// The frame's `color_time_ns`.
    pub time_ns: i64,
    /// Why there is a pose, or none.
    pub outcome: Outcome,
    /// Where the camera was; there where the outcome is [`Outcome::Localized`].
    pub pose: Option<Pose>,
    /// The map that the pose is in; where there is no pose, the likeliest.
    pub map_id: Option<u32>,
    /// After this frame.
    pub state: State,
    /// Found in the colour image.
    pub keypoints: u32,
    /// Of these, with depth.
    pub lifted: u32,
    /// Keypoints with a map point that passed the ratio test, lifted or not.
    pub matches: u32,
    /// Lifted and agreeing with the pose: of these, and where `frames` > 1 of earlier ones.
    pub inliers: u32,
    /// Minimal samples drawn, in all searches.
    pub iterations: u32,
    /// Whose matches the pose was found from: 1, or more where odometry put some together.
    pub frames: u32,
    /// Found where it was expected, without a search of the whole map.
    pub guided: bool,
    /// What is wrong with the frame.
    pub faults: Faults,
    /// What was left out for the deadline.
    pub cuts: Cuts,
    /// Why there is no pose.
    pub hints: Hints,
    /// What the pose does to a world that earlier ones drew.
    pub events: Events,
    /// How far the camera's centre is from where it was expected.
    pub jump_m: f64,
    /// By which angle the camera is from where it was expected.
    pub jump_rad: f64,
    /// What the frame was looked at with.
    pub depth: DepthBias,
    /// Time of each stage, by the config's clock.
    pub times: StageTimes,
}

/// A pose, and how sure it is.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Pose {
    /// The pose.
    pub camera_from_map: Rigid,
    /// Row-major 6 x 6 covariance of (rotation vector rad, translation m), both in the camera's frame, for a
    /// perturbation applied on the left: T = exp(xi) T_estimate.
    pub covariance: [f64; 36],
    /// Probability that the pose is within 5 cm and 5 degrees.
    pub confidence: f64,
}

impl Pose {
    /// The probability that the camera is within so many metres and radians of the pose; 0 for a bound that is not
    /// above 0.
    pub fn confidence_within(&self, translation_m: f64, rotation_rad: f64) -> f64 {
        // SAFETY: all zero is a value of it; the call is [pure].
        let mut raw: sys::sphc_localizer_result = unsafe { zeroed() };
        raw.struct_size = core::mem::size_of::<sys::sphc_localizer_result>() as u32;
        raw.outcome = sys::SPHC_OUTCOME_LOCALIZED;
        raw.camera_from_map = self.camera_from_map.to_raw();
        raw.covariance = self.covariance;
        raw.confidence = self.confidence;
        unsafe { sys::sphc_localizer_result_confidence(&raw, translation_m, rotation_rad) }
    }
}

/// Time of each stage in microseconds; zeros without a clock.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct StageTimes {
    /// Finding and describing keypoints.
    pub features_us: u32,
    /// Giving them depth.
    pub align_us: u32,
    /// Comparing them with the map.
    pub match_us: u32,
    /// Finding the pose.
    pub pose_us: u32,
}

/// How the depth sensor is off: true z = z + offset_m + slope (z - mid_m), and its noise is `noise_scale` times the one
/// in the config.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct DepthBias {
    /// Depth around which it turns.
    pub mid_m: f64,
    /// Added to a depth of `mid_m`.
    pub offset_m: f64,
    /// Metres a metre.
    pub slope: f64,
    /// 1 sigma.
    pub offset_sigma_m: f64,
    /// 1 sigma.
    pub slope_sigma: f64,
    /// Of offset and slope.
    pub correlation: f64,
    /// Of the sensor's noise.
    pub noise_scale: f64,
}
same_layout!(DepthBias, sys::sphc_depth_bias);

impl DepthBias {
    pub(crate) fn as_raw(&self) -> *const sys::sphc_depth_bias {
        (self as *const Self).cast()
    }

    fn from_raw(raw: &sys::sphc_depth_bias) -> Self {
        Self {
            mid_m: raw.mid_m,
            offset_m: raw.offset_m,
            slope: raw.slope,
            offset_sigma_m: raw.offset_sigma_m,
            slope_sigma: raw.slope_sigma,
            correlation: raw.correlation,
            noise_scale: raw.noise_scale,
        }
    }
}

/// Where the colour camera is at a time of the caller's, such as when a display lights up.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Prediction {
    /// The map that the pose is in.
    pub map_id: u32,
    /// The time that was asked for.
    pub time_ns: i64,
    /// Of the frame whose pose this one comes from.
    pub pose_time_ns: i64,
    /// After the last frame.
    pub state: State,
    /// The pose.
    pub camera_from_map: Rigid,
    /// As [`Pose::covariance`]; grows with the time since the frame.
    pub covariance: [f64; 36],
    /// Of the camera's centre, along the map's axes.
    pub velocity_in_map_m_s: [f64; 3],
    /// Of the camera, about the map's axes, right-handed.
    pub angular_velocity_in_map_rad_s: [f64; 3],
    /// 1 sigma an axis.
    pub velocity_sigma_m_s: f64,
    /// 1 sigma an axis.
    pub angular_velocity_sigma_rad_s: f64,
}

/// What became of one keypoint of the last processed frame; for overlays and diagnosis.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
#[non_exhaustive]
pub struct Observation {
    /// In the image of its camera, to the right.
    pub x_px: f32,
    /// In the image of its camera, downwards.
    pub y_px: f32,
    /// Standard deviation of the Gaussian it was found at.
    pub scale_px: f32,
    /// z in that camera; 0 unless lifted.
    pub depth_m: f32,
    point_index: u32,
    /// What became of it.
    pub flags: ObservationFlags,
    /// 0: the colour camera; i: the i-th further camera.
    pub camera: u32,
}
same_layout!(Observation, sys::sphc_localizer_observation);

impl Observation {
    /// The map point that it was matched with, of the map that [`Localization::map_id`] names.
    pub fn point_index(&self) -> Option<u32> {
        self.flags.contains(ObservationFlags::MATCHED).then_some(self.point_index)
    }
}

/// A pose that the last processed frame may have.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Hypothesis {
    /// The map that the pose is in.
    pub map_id: u32,
    /// What the pose would be without the others.
    pub outcome: Outcome,
    /// As [`Localization::inliers`].
    pub inliers: u32,
    /// This is the frame's pose; at most one is.
    pub is_result: bool,
    /// The pose.
    pub camera_from_map: Rigid,
    /// Sum over its inliers of 1 - (squared residual / its limit): what poses are compared by.
    pub gain: f64,
    /// Natural logarithm of a bound on the probability that chance agrees so well.
    pub log_chance: f64,
}

impl Localization {
    pub(crate) fn from_raw(raw: &sys::sphc_localizer_result) -> Self {
        let outcome = Outcome::from_raw(raw.outcome);
        let pose = || Pose {
            camera_from_map: Rigid::from_raw(&raw.camera_from_map),
            covariance: raw.covariance,
            confidence: raw.confidence,
        };
        Self {
            sequence: raw.sequence,
            time_ns: raw.time_ns,
            outcome,
            pose: (outcome == Outcome::Localized).then(pose),
            map_id: (raw.map_id != sys::SPHC_MAP_NONE).then_some(raw.map_id),
            state: State::from_raw(raw.state),
            keypoints: raw.keypoints,
            lifted: raw.lifted,
            matches: raw.matches,
            inliers: raw.inliers,
            iterations: raw.iterations,
            frames: raw.frames,
            guided: raw.guided != 0,
            faults: Faults::from_bits(raw.faults),
            cuts: Cuts::from_bits(raw.cuts),
            hints: Hints::from_bits(raw.hints),
            events: Events::from_bits(raw.events),
            jump_m: raw.jump_m,
            jump_rad: raw.jump_rad,
            depth: DepthBias::from_raw(&raw.depth),
            times: StageTimes {
                features_us: raw.features_us,
                align_us: raw.align_us,
                match_us: raw.match_us,
                pose_us: raw.pose_us,
            },
        }
    }
}

impl Prediction {
    pub(crate) fn from_raw(raw: &sys::sphc_localizer_prediction) -> Self {
        Self {
            map_id: raw.map_id,
            time_ns: raw.time_ns,
            pose_time_ns: raw.pose_time_ns,
            state: State::from_raw(raw.state),
            camera_from_map: Rigid::from_raw(&raw.camera_from_map),
            covariance: raw.covariance,
            velocity_in_map_m_s: raw.velocity_in_map_m_s,
            angular_velocity_in_map_rad_s: raw.angular_velocity_in_map_rad_s,
            velocity_sigma_m_s: raw.velocity_sigma_m_s,
            angular_velocity_sigma_rad_s: raw.angular_velocity_sigma_rad_s,
        }
    }
}

impl Hypothesis {
    pub(crate) fn from_raw(raw: sys::sphc_localizer_hypothesis) -> Self {
        Self {
            map_id: raw.map_id,
            outcome: Outcome::from_raw(raw.outcome),
            inliers: raw.inliers,
            is_result: raw.is_result != 0,
            camera_from_map: Rigid::from_raw(&raw.camera_from_map),
            gain: raw.gain,
            log_chance: raw.log_chance,
        }
    }
}
