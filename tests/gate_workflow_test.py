#!/usr/bin/env python3
"""The workflows that `check --init` writes do their work: in an empty repository with a decoder of its own, the
commands of each are run as the servers run them, with a decoder that is as good as the baseline and with one that is
not. The program is there already, so that nothing is fetched.

Usage: gate_workflow_test.py PROGRAM SOURCES; exits 1 saying what is otherwise, 77 (skipped) without PyYAML.
"""
import os
import pathlib
import subprocess
import sys
import tempfile

DECODER = "python3 decoder.py {vcd}"
GITLAB, GITHUB = ".gitlab-ci.yml", ".github/workflows/receiver-gate.yml"


class Repository:
    """A firmware's: a decoder, which make checks, and a scenario."""

    def __init__(self, folder, program, sources):
        self.folder = pathlib.Path(folder)
        tools = self.folder / "bin"
        self.work = self.folder / "firmware"
        for path in (tools, self.work):
            path.mkdir()
        (tools / "cosys-sim").symlink_to(program)
        self.environment = {**os.environ, "PATH": f"{tools}:{os.environ['PATH']}"}
        self.mutants = sources / "tests/mutants/mutants.py"
        (self.work / "gate.toml").write_text((sources / "scenarios/gate/gate_range_edge.toml").read_text())
        (self.work / "Makefile").write_text("all:\n\tpython3 -m py_compile decoder.py\n")
        self.use("sound")
        self.run("git init -q .")

    def use(self, mutant):
        """Makes one of the test's decoders the repository's."""
        text = self.mutants.read_text().replace('default="sound"', f'default="{mutant}"')
        expect(f'default="{mutant}"' in text, "the mutants' default is the sound decoder")
        (self.work / "decoder.py").write_text(text)

    def run(self, script, shell="bash", expected=0, **environment):
        done = subprocess.run([shell, "-e", "-c", script], cwd=self.work, text=True, check=False,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              env={**self.environment, **environment})
        if done.returncode != expected:
            sys.exit(f"exit code {done.returncode}, not {expected}, of\n{script}\n{done.stdout}")
        return done.stdout

    def read(self, name):
        return (self.work / name).read_text()


def expect(condition, what):
    if not condition:
        sys.exit(f"not so: {what}")


def steps_of_github(text):
    """The scripts of the one job, in order; in a container a server runs them by sh -e."""
    import yaml
    job = yaml.safe_load(text)["jobs"]["receiver-gate"]
    expect(job["container"] == "debian:12", "GitHub's job has a container")
    return [step["run"] for step in job["steps"] if "run" in step]


def run_github(repository, expected):
    summary = repository.folder / "summary.md"
    summary.write_text("")
    scripts = steps_of_github(repository.read(GITHUB))
    expect(scripts[1] == "make", f"it builds the decoder: {scripts[1]}")
    for script in scripts:
        last = script is scripts[-1]
        repository.run(script, "sh", expected if last else 0, GITHUB_STEP_SUMMARY=str(summary))
    return summary.read_text()


def run_gitlab(repository, expected):
    import yaml
    job = yaml.safe_load(repository.read(GITLAB))["receiver-gate"]
    expect(job["allow_failure"] == {"exit_codes": 4}, "GitLab lets an inconclusive check pass")
    expect(job["artifacts"]["reports"] == {"junit": "check.xml"}, "GitLab has the JUnit file")
    repository.run("set -o pipefail\n" + "\n".join(job["script"]), "bash", expected)


def check_outputs(repository, verdict):
    expect(f"## Receiver gate: {verdict}\n" in repository.read("check.md"), f"the summary says {verdict}")
    expect("<testsuite name=" in repository.read("check.xml"), "there is a JUnit file")
    expect(verdict in repository.read("check.csv"), f"the table says {verdict}")


def test(repository):
    repository.run(f"cosys-sim baseline gate.toml --decoder '{DECODER}' --decoder-output frames -q -o gate.h5")
    init = (f"cosys-sim check gate.toml --baseline gate.h5 --decoder '{DECODER}' --decoder-output frames --init")
    said = repository.run(init)
    expect(said.startswith(f"{GITHUB}\n{GITLAB}\ncommit these"), f"init says what it wrote: {said}")
    repository.run(init)  # its own files are replaced
    summary = run_github(repository, 0)
    expect("## Receiver gate: passed\n" in summary, "the server's page says passed")
    run_gitlab(repository, 0)
    check_outputs(repository, "passed")

    repository.use("checksum-ignored")
    summary = run_github(repository, 1)
    for part in ("## Receiver gate: worse\n", "### Frames to look at", "the pin first differs from the light at", "█"):
        expect(part in summary, f"the server's page has {part}")
    run_gitlab(repository, 1)
    check_outputs(repository, "worse")


def test_refusals(repository):
    (repository.work / GITLAB).write_text("build:\n  script: make\n")
    init = f"cosys-sim check gate.toml --baseline gate.h5 --decoder '{DECODER}' --decoder-output frames --init"
    said = repository.run(init)
    expect("include: .gitlab/receiver-gate.yml" in said, f"a pipeline that is there keeps its jobs: {said}")
    expect(repository.read(GITLAB) == "build:\n  script: make\n", "it is as it was")
    (repository.work / GITHUB).write_text("name: mine\n")
    repository.run(init, expected=2)
    outside = init.replace("gate.toml", str(repository.work / "gate.toml"))
    expect("it is not in this repository" in repository.run(outside, expected=2), "a file elsewhere is refused")


def main(program, sources):
    try:
        import yaml  # noqa: F401
    except ImportError:
        script = pathlib.Path(__file__).parent / "skip.sh"
        sys.exit(subprocess.run([script, "gate_workflow", "needs PyYAML (Debian: python3-yaml)"],
                                check=False).returncode)
    with tempfile.TemporaryDirectory() as folder:
        repository = Repository(folder, pathlib.Path(program).resolve(), pathlib.Path(sources).resolve())
        test(repository)
        test_refusals(repository)


main(*sys.argv[1:])
