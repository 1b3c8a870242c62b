//! What C found, to the last bit.
use crate::session::{localizer, number, numbers, steps, Row};
use spherecloud::{Localization, Outcome, Prediction, Rigid, State};

fn pose(row: &Row, prefix: &str) -> Rigid {
    let name = |part| format!("{prefix}{part}");
    Rigid {
        q_wxyz: ["q_w", "q_x", "q_y", "q_z"].map(|part| number(row, &name(part))),
        t_m: ["t_x", "t_y", "t_z"].map(|part| number(row, &name(part))),
    }
}

fn compare(row: &Row, found: &Localization) {
    assert_eq!(found.sequence, number::<u32>(row, "sequence"));
    assert_eq!(found.time_ns, number::<i64>(row, "color_time_ns"));
    assert_eq!(found.outcome, Outcome::from_raw(number(row, "outcome")));
    assert_eq!(found.state, State::from_raw(number(row, "state")));
    assert_eq!(found.keypoints, number::<u32>(row, "keypoints"));
    assert_eq!(found.inliers, number::<u32>(row, "inliers"));
    assert_eq!(found.pose.is_some(), row["status"] == "0");
    if let Some(found) = &found.pose {
        assert_eq!(found.camera_from_map, pose(row, ""));
        assert_eq!(found.confidence, number::<f64>(row, "confidence"));
        assert_eq!([found.covariance[0], found.covariance[35]], numbers(row, ["covariance_0", "covariance_35"]));
        assert_eq!(found.confidence_within(0.05, 5f64.to_radians()), found.confidence);
        assert!(found.confidence_within(0.001, 0.001) < found.confidence);
        assert_eq!(found.confidence_within(0.0, 1.0), 0.0);
    }
}

fn compare_prediction(row: &Row, found: Option<Prediction>) {
    assert_eq!(found.is_some(), row["predicted_status"] == "0");
    if let Some(found) = found {
        assert_eq!(found.camera_from_map, pose(row, "predicted_"));
        assert_eq!(found.map_id, crate::session::MAP_ID);
        assert!(found.pose_time_ns < found.time_ns);
    }
}

#[test]
fn session_is_that_of_c() {
    let mut localizer = localizer();
    let steps = steps();
    assert!(steps.len() >= 10);
    for step in &steps {
        let found = localizer.process(&step.frame()).unwrap();
        compare(&step.row, &found);
        assert!(found.times.features_us > 0, "the default clock ticks");
        compare_prediction(&step.row, localizer.predict(found.time_ns + 20_000_000).unwrap());
    }
}

#[test]
fn halves_find_the_same() {
    let mut localizer = localizer();
    let mut features = spherecloud::Features::new(&crate::session::config()).unwrap();
    for step in &steps() {
        let frame = step.frame();
        let (mut extractor, mut locator) = localizer.split();
        extractor.extract(&frame, &mut features).unwrap();
        let mut without_color = frame;
        without_color.color = None;
        let found = locator.locate(&without_color, &features).unwrap();
        compare(&step.row, &found);
        compare_prediction(&step.row, locator.predict(found.time_ns + 20_000_000).unwrap());
    }
}

#[test]
fn frames_are_explained() {
    let (mut localizer, steps) = (localizer(), steps());
    assert!(localizer.observations().unwrap().is_empty());
    let found = localizer.process(&steps[0].frame()).unwrap();
    assert_eq!(found.map_id, Some(crate::session::MAP_ID));

    let observations = localizer.observations().unwrap();
    assert_eq!(observations.len(), found.keypoints as usize);
    let matched = observations.iter().filter_map(|observation| observation.point_index()).collect::<Vec<_>>();
    assert_eq!(matched.len(), found.matches as usize);
    let points = crate::session::map().info().point_count;
    assert!(matched.iter().all(|&index| index < points));
    let mut few = observations[..3].to_vec();
    few.iter_mut().for_each(|observation| observation.x_px = -1.0);
    assert_eq!(localizer.observations_into(&mut few).unwrap(), observations.len());
    assert_eq!(few, observations[..3]);

    let hypotheses = localizer.hypotheses().unwrap().collect::<Vec<_>>();
    let result = hypotheses.iter().find(|hypothesis| hypothesis.is_result).unwrap();
    assert_eq!(result.camera_from_map, found.pose.unwrap().camera_from_map);
    assert_eq!(result.outcome, Outcome::Localized);
}

#[test]
fn every_state_of_the_localizer_is_reached() {
    let (mut localizer, steps) = (localizer(), steps());
    let states: Vec<State> = steps.iter().map(|step| localizer.process(&step.frame()).unwrap().state).collect();
    assert_eq!(states[..2], [State::Relocalizing, State::Tracking]);
    localizer.reset();
    assert_eq!(localizer.predict(number(&steps[9].row, "color_time_ns")).unwrap(), None);
}
