#!/usr/bin/env python3
"""Holds today's headers to the rules of docs/abi.md, on every machine of spherecloud.json.

    growth_rules.py     what a binding can hold; and that programs of each header in headers/ go on with today's

Needs the package libclang (toolchains/python_packages.txt).
"""
import pathlib
import re
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent.parent / "toolchains"))
import describe_interface  # noqa: E402 (its folder is named above)

FIXED = {f"{sign}int{bits}_t" for sign in ("", "u") for bits in (8, 16, 32, 64)} | {"float", "double", "char"}
BYTES = {"uint32_t": 4, "int32_t": 4, "float": 4, "uint64_t": 8, "int64_t": 8, "double": 8}
STRIDED = {"sphc_localizer_observation", "sphc_localizer_hypothesis"}  # elements at a stride of the caller's grow as well
SAME_FOR_EVER = {"SPHC_MESSAGE_BYTES", "SPHC_MAP_NONE"}


def by_name(things):
    return {thing["name"]: thing for thing in things}


def stable(told, what):
    return by_name(one for one in told[what] if one["header"] == "spherecloud.h")


def grows(struct):
    return struct["grows"] or struct["name"] in STRIDED


def unbindable(told):
    """What a language with a C interface and nothing else cannot hold, or what would stop growth."""
    structs, faults = by_name(told["structs"]), []
    fixed = FIXED | set(told["types"]) | set(by_name(told["callbacks"])) | set(structs)
    for struct in structs.values():
        for field in struct["fields"]:
            base = re.sub(r"\[\d+\]", "", field["type"]).strip()
            if "*" not in base and base not in fixed:
                faults.append(f"{struct['name']}.{field['name']} is of type {base}, which is of no fixed width")
            if base in structs and structs[base]["grows"]:
                faults.append(f"{struct['name']}.{field['name']} is a {base}, which grows")
    for function in told["functions"]:
        for passed in [function["returns"]] + [parameter["type"] for parameter in function["parameters"]]:
            if passed.replace("const ", "") in structs:
                faults.append(f"{function['name']} passes a {passed} by value")
    return faults


def goes_on(old, new, types):
    """The same field, or one of as many bytes in the place of a reserved one, which older programs leave zero."""
    if old["name"].startswith("reserved") and old["type"] in BYTES:
        return BYTES.get(types.get(new["type"], new["type"])) == BYTES[old["type"]]
    return (old["name"], old["type"]) == (new["name"], new["type"])


def broken_struct(before, now, types):
    old, new, name = before["fields"], now["fields"], before["name"]
    faults = [f"{name} had {a['type']} {a['name']} where it has {b['type']} {b['name']}"
              for a, b in zip(old, new) if not goes_on(a, b, types)]
    if faults:
        return faults[:1]  # what follows has moved with it
    if len(new) < len(old) or (len(new) > len(old) and not grows(before)):
        faults.append(f"{name} had {len(old)} fields and has {len(new)}")
    for machine, was in before["layouts"].items():
        faults += moved(name, was, now["layouts"][machine], machine)
    return faults


def moved(struct, was, now, machine):
    """The first place where a machine's layout of a struct has broken."""
    offsets, fields = list(was["offsets"].values()), list(now["offsets"].items())
    for offset, (field, is_at) in zip(offsets, fields):
        if is_at != offset:
            return [f"{struct}.{field} has moved on {machine}"]
    added = fields[len(offsets):]
    for field, is_at in added:
        if is_at < was["bytes"]:  # which an older program never set
            return [f"{struct}.{field} lies in what was padding on {machine}: put a field of 8 bytes in front of it"]
    if now["alignment"] != was["alignment"] or (not added and now["bytes"] != was["bytes"]):
        return [f"{struct} has another size or alignment on {machine}"]
    return []


def broken_constants(before, now):
    names = {name: value for name, value in before["constants"].items() if name in SAME_FOR_EVER}
    names |= {v["name"]: v["value"] for enum in stable_enums(before) for v in enum["values"]}
    values = dict(now["constants"]) | {v["name"]: v["value"] for enum in now["enums"] for v in enum["values"]}
    faults = [f"{name} was {value} and is {values.get(name)}" for name, value in names.items() if values.get(name) != value]
    bounds = {name: value for name, value in before["constants"].items() if name.endswith("_BYTES_MAX")}
    return faults + [f"{name} was {value}, which programs have reserved" for name, value in bounds.items()
                     if now["constants"].get(name, value) > value]


def stable_enums(told):
    return [enum for enum in told["enums"] if enum["header"] == "spherecloud.h"]


def broken(before, now):
    """Why a program of the header `before` could not go on."""
    faults = broken_constants(before, now)
    structs, functions = by_name(now["structs"]), by_name(now["functions"])
    for name, struct in stable(before, "structs").items():
        faults += broken_struct(struct, structs[name], now["types"]) if name in structs else [f"{name} is gone"]
    for name, function in stable(before, "functions").items():
        if name not in functions:
            faults.append(f"{name} is gone")
        elif signature(function) != signature(functions[name]):
            faults.append(f"{name} was {signature(function)} and is {signature(functions[name])}")
    for kind, types in (("callback", by_name(before["callbacks"])), ("type", before["types"])):
        after = by_name(now["callbacks"]) if kind == "callback" else now["types"]
        for name, was in types.items():
            was, is_now = (one["type"] if isinstance(one, dict) else one for one in (was, after.get(name, "nothing")))
            if was != is_now:
                faults.append(f"{name} was {was} and is {is_now}")
    return faults


def signature(function):
    return f"{function['returns']} ({', '.join(p['type'] for p in function['parameters'])})"


def main():
    today = describe_interface.describe()
    faults = unbindable(today)
    for folder in sorted((HERE / "headers").iterdir()):
        kept = describe_interface.describe(folder / "spherecloud")
        faults += [f"since {folder.name}: {fault}" for fault in broken(kept, today)]
    if faults:
        sys.exit("against the rules of docs/abi.md:\n" + "\n".join(faults))


if __name__ == "__main__":
    main()
