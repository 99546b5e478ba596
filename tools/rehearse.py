#!/usr/bin/env python3
"""Runs the steps of a job of .github/workflows/release.yml in a bare Debian, as the release would: ./dev rehearse.

  ./dev rehearse [--job linux] [--skip TEXT] [--root FOLDER]

Needs root, debootstrap, PyYAML, and an hour for `./dev test`, which --skip 'dev test' leaves out. What is committed is rehearsed,
nothing else. The root gets this machine's mirror, certificates and proxies, so that it reaches packages as this machine does; it has
no tool that the steps do not install. With --root it stays there for a look. Made packages end in out/rehearsal.
"""
import argparse
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import yaml

SOURCE = pathlib.Path(__file__).resolve().parent.parent
BUNDLE = pathlib.Path("/etc/ssl/certs/ca-certificates.crt")
INSIDE = "/github/workspace"
SUITES = {"debian:12": "bookworm", "debian:13": "trixie"}


def mirror():
    """The first Debian mirror that apt here is set up with."""
    places = pathlib.Path("/etc/apt")
    for file in [places / "sources.list", *sorted((places / "sources.list.d").glob("*"))]:
        if file.is_file():
            found = re.search(r"^(?:deb\s+(?:\[.*?\]\s+)?|URIs:\s*)(\S+/debian/?)\s", file.read_text(), re.M)
            if found:
                return found[1]
    sys.exit("apt on this machine has no mirror of Debian; the rehearsal needs one")


def environment(version):
    """What GitHub sets for a step, and what leads to this machine's packages."""
    given = {"PATH": "/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin", "HOME": "/github/home", "CI": "true",
             "GITHUB_REF_NAME": f"v{version}", "GITHUB_REPOSITORY": "owner/sillon"}
    names = re.compile(r"(?i)^(https?_proxy|no_proxy|pip_(index_url|default_timeout)|npm_config_registry)$")
    given |= {name: value for name, value in os.environ.items() if names.match(name)}
    if BUNDLE.exists():
        for name in ["PIP_CERT", "SSL_CERT_FILE", "NODE_EXTRA_CA_CERTS", "npm_config_cafile"]:
            given[name] = "/github/certificates.crt"
    return given


def furnish(root, container):
    """A root as the container's image is: Debian's smallest, with the committed source in it."""
    if not (root / "etc/debian_version").exists():
        subprocess.run(["debootstrap", "--variant=minbase", SUITES[container], root, mirror()], check=True)
    shutil.copy("/etc/resolv.conf", root / "etc/resolv.conf")
    shutil.rmtree(root / "github", ignore_errors=True)
    for folder in [root / INSIDE[1:], root / "github/home"]:
        folder.mkdir(parents=True)
    if BUNDLE.exists():
        shutil.copy(BUNDLE, root / "github/certificates.crt")
    source = subprocess.Popen(["git", "-C", SOURCE, "archive", "HEAD"], stdout=subprocess.PIPE)
    subprocess.run(["tar", "x", "-C", root / INSIDE[1:]], stdin=source.stdout, check=True)


def run(root, step, variables):
    """A step as GitHub runs it in a container. Mounts end with it."""
    inside = f'mount -t proc proc "$0/proc"; mount --rbind /dev "$0/dev"; cd "$0"; exec chroot . sh -c "cd {INSIDE}; bash -e step"'
    (root / INSIDE[1:] / "step").write_text(step)
    command = ["unshare", "--mount", "--propagation", "private", "sh", "-ec", inside, root]
    return subprocess.run(command, env=variables, stdin=subprocess.DEVNULL).returncode


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--job", default="linux")
    options.add_argument("--skip", help="leaves out steps that hold this text")
    options.add_argument("--root", type=pathlib.Path, help="where the system lies, and stays; one that is there is used again")
    given = options.parse_args()
    if os.getuid() != 0:
        sys.exit("the rehearsal changes its root; it must be run as root")
    jobs = yaml.safe_load((SOURCE / ".github/workflows/release.yml").read_text())["jobs"]
    bare = [name for name, job in jobs.items() if job.get("container") in SUITES]
    if given.job not in bare:
        sys.exit(f"--job is {given.job}; it must be one in a container of Debian: {', '.join(bare)}")
    job = jobs[given.job]
    version = subprocess.run([SOURCE / "dev", "version"], check=True, capture_output=True, text=True).stdout.strip()
    with tempfile.TemporaryDirectory() as folder:
        root = (given.root or pathlib.Path(folder)).resolve()
        root.mkdir(parents=True, exist_ok=True)
        furnish(root, job["container"])
        for step in job["steps"]:
            if "run" not in step or (given.skip and given.skip in step["run"]):
                continue
            print(f"--- {step['run'].strip()}", flush=True)
            variables = environment(version) | job.get("env", {}) | step.get("env", {})
            if "${{" in str([step["run"], variables]):
                sys.exit("the step holds an expression that only GitHub can read")
            code = run(root, step["run"], variables)
            if code != 0:
                sys.exit(f"the job {given.job} ends here, with {code}")
        made, packages = SOURCE / "out/rehearsal", root / INSIDE[1:] / "out/package"
        if not packages.exists():
            sys.exit(f"the job {given.job} has packed nothing")
        shutil.rmtree(made, ignore_errors=True)
        shutil.copytree(packages, made)
        print(f"the job {given.job} is through: {', '.join(sorted(os.listdir(made)))} in {made}")


main()
