//! Golden poses of OpenXR, Unity, ROS, COLMAP and TUM.
use crate::session::{rows, Row};
use spherecloud::{Camera, Convention, Rigid, Status};

/// The fields whose names begin so; empty where the row has none.
fn numbers(row: &Row, name: &str, parts: &[&str]) -> Vec<f64> {
    parts.iter().filter_map(|part| row[&format!("{name}_{part}")].parse().ok()).collect()
}

fn rigid(row: &Row, name: &str) -> Option<Rigid> {
    let numbers = numbers(row, name, &["qw", "qx", "qy", "qz", "x", "y", "z"]);
    let q_wxyz = numbers.get(..4)?.try_into().unwrap();
    Some(Rigid { q_wxyz, t_m: numbers[4..].try_into().unwrap() })
}

fn pose(row: &Row, name: &str) -> [f64; 7] {
    numbers(row, name, &["0", "1", "2", "3", "4", "5", "6"]).try_into().unwrap()
}

fn convention(name: &str) -> Convention {
    (1..7).map(Convention::from_raw).find(|known| known.name() == format!("SPHC_CONVENTION_{name}")).unwrap()
}

fn assert_near(found: &[f64], wanted: &[f64]) {
    assert_eq!(found.len(), wanted.len());
    assert!(found.iter().zip(wanted).all(|(f, w)| (f - w).abs() < 1e-12), "{found:?} is not {wanted:?}");
}

fn assert_same(found: Rigid, wanted: Rigid) {
    assert_near(&found.q_wxyz, &wanted.q_wxyz);
    assert_near(&found.t_m, &wanted.t_m);
}

#[test]
fn poses_are_those_of_the_other_systems() {
    let path = std::env::var_os("SPHERECLOUD_CONVENTIONS").expect("SPHERECLOUD_CONVENTIONS is conventions.csv");
    let vectors = rows(&std::fs::read_to_string(path).unwrap());
    assert!(vectors.len() > 60);
    for row in &vectors {
        let convention = convention(&row["convention"]);
        let (told, camera) = (rigid(row, "world_from_map"), rigid(row, "camera_from_map").unwrap());
        let world = told.unwrap_or_default();
        if let [x, y, z] = numbers(row, "up_map", &["x", "y", "z"])[..] {
            assert_same(convention.make_world([x, y, z]).unwrap(), world);
        }
        assert_near(&convention.write_camera(told.as_ref(), &camera).unwrap(), &pose(row, "camera_pose"));
        assert_same(convention.read_camera(told.as_ref(), &pose(row, "camera_pose")).unwrap(), camera);
        assert_near(&convention.write_map(&world).unwrap(), &pose(row, "map_pose"));
        assert_same(convention.read_map(&pose(row, "map_pose")).unwrap(), world);
    }
}

#[test]
fn what_is_no_pose_is_refused() {
    let nothing = Convention::Tum.read_camera(None, &[f64::NAN; 7]).unwrap_err();
    assert_eq!(nothing.status(), Status::Argument);
    let needs_a_world = Convention::Openxr.write_camera(None, &Rigid::IDENTITY).unwrap_err();
    assert_eq!(needs_a_world.status(), Status::Argument);
    let newer = Convention::from_raw(99);
    assert_eq!(newer, Convention::Unknown(99));
    assert_eq!(newer.write_map(&Rigid::IDENTITY).unwrap_err().status(), Status::Unsupported);
    assert_eq!(newer.name(), "SPHC_CONVENTION_?");
}

#[test]
fn transforms_and_cameras() {
    let quarter = 0.5f64.sqrt();
    let b_from_a = Rigid { q_wxyz: [quarter, 0.0, 0.0, quarter], t_m: [1.0, 2.0, 3.0] };
    assert_near(&b_from_a.apply([1.0, 0.0, 0.0]), &[1.0, 3.0, 3.0]);
    assert_same(b_from_a.inverse() * b_from_a, Rigid::IDENTITY);

    let camera = Camera::brown5(640, 480, [500.0, 500.0, 320.0, 240.0, 0.01, 0.0, 0.0, 0.0, 0.0]);
    camera.check().unwrap();
    let bearing = camera.unproject([100.0, 50.0]).unwrap();
    assert_near(&camera.project(bearing).unwrap().map(|px| (px * 1e6).round() / 1e6), &[100.0, 50.0]);
    assert_eq!(camera.project([0.0, 0.0, -1.0]), None);
    assert_eq!(camera.params().len(), 9);
}
