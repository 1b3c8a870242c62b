//! Finds the library: SPHERECLOUD_LIB_DIR, then `pkg-config spherecloud`.
use std::env;
use std::path::{Path, PathBuf};
use std::process::Command;

const CURE: &str = "Install the SDK, then set SPHERECLOUD_LIB_DIR to the folder that has libspherecloud, \
or PKG_CONFIG_PATH to the folder that has spherecloud.pc (lib/pkgconfig of the installation).";

fn main() {
    for name in ["SPHERECLOUD_LIB_DIR", "PKG_CONFIG_PATH", "PKG_CONFIG"] {
        println!("cargo:rerun-if-env-changed={}", name);
    }
    // Documentation links nothing.
    if env::var_os("DOCS_RS").is_some() {
        return;
    }
    let is_static = env::var_os("CARGO_FEATURE_STATIC").is_some();
    let folder = env::var_os("SPHERECLOUD_LIB_DIR").map(PathBuf::from);
    let linked = match &folder {
        Some(folder) => link_folder(folder, is_static),
        None => link_pkg_config(None, is_static),
    };
    if let Err(why) = linked {
        eprintln!("error: libspherecloud was not found.\n{}\n{}", why, CURE);
        std::process::exit(1);
    }
}

fn link_folder(folder: &Path, is_static: bool) -> Result<(), String> {
    let names: &[&str] = match is_static {
        true => &["libspherecloud.a", "spherecloud.lib"],
        false => &["libspherecloud.so", "libspherecloud.dylib", "libspherecloud.dll.a", "spherecloud.lib"],
    };
    if !names.iter().any(|name| folder.join(name).exists()) {
        return Err(format!("SPHERECLOUD_LIB_DIR is {}, which has no {}.", folder.display(), names[0]));
    }
    println!("cargo:rustc-link-search=native={}", folder.display());
    println!("cargo:rustc-link-lib={}=spherecloud", if is_static { "static" } else { "dylib" });
    let pkgconfig = folder.join("pkgconfig");
    match is_static {
        true if pkgconfig.join("spherecloud.pc").exists() => link_pkg_config(Some(&pkgconfig), true),
        // A folder of a build tree: what the static library needs on machines with an operating system.
        true if env::var("CARGO_CFG_TARGET_OS").map_or(true, |system| system != "none") => {
            println!("cargo:rustc-link-lib=hwy");
            println!("cargo:rustc-link-lib=m");
            Ok(())
        }
        _ => Ok(()),
    }
}

/// What `pkg-config --libs` says, searched in `folder` alone where one is given.
fn link_pkg_config(folder: Option<&Path>, is_static: bool) -> Result<(), String> {
    let program = env::var_os("PKG_CONFIG").unwrap_or_else(|| "pkg-config".into());
    let mut command = Command::new(&program);
    command.args(["--libs", "spherecloud"]).args(if is_static { Some("--static") } else { None });
    if let Some(folder) = folder {
        command.env("PKG_CONFIG_PATH", folder);
    }
    if is_static {
        // rustc looks for a static library itself, and knows no folder of the system.
        command.env("PKG_CONFIG_ALLOW_SYSTEM_LIBS", "1");
    }
    let told = command.output().map_err(|why| format!("SPHERECLOUD_LIB_DIR is not set; {:?}: {}.", program, why))?;
    if !told.status.success() {
        let why = String::from_utf8_lossy(&told.stderr);
        return Err(format!("SPHERECLOUD_LIB_DIR is not set, and {:?} says: {}", program, why.trim()));
    }
    String::from_utf8_lossy(&told.stdout).split_whitespace().for_each(|flag| link_flag(flag, is_static));
    Ok(())
}

fn link_flag(flag: &str, is_static: bool) {
    if let Some(folder) = flag.strip_prefix("-L") {
        println!("cargo:rustc-link-search=native={}", folder);
    } else if flag == "-lspherecloud" && is_static {
        println!("cargo:rustc-link-lib=static=spherecloud");
    } else if let Some(library) = flag.strip_prefix("-l") {
        println!("cargo:rustc-link-lib={}", library);
    }
}
