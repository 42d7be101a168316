# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""What ships for Kubernetes and for compose, by the tools of it that Debian has: fields and types by the
classes of python3-kubernetes, compose by docker-compose. And what no tool sees: that what names
something else in these files finds it."""

import inspect
import pathlib
import re
import subprocess
import unittest

import kubernetes.client as api
import running
import yaml

KUBERNETES = running.ROOT / "deploy/kubernetes"
COMPOSE = running.ROOT / "deploy/container/compose.yaml"
CLASSES = {
    ("v1", "Service"): api.V1Service,
    ("apps/v1", "StatefulSet"): api.V1StatefulSet,
    ("policy/v1", "PodDisruptionBudget"): api.V1PodDisruptionBudget,
    ("networking.k8s.io/v1", "NetworkPolicy"): api.V1NetworkPolicy,
}
PLAIN = {"str": str, "int": int, "bool": bool, "object": object, "datetime": str}


def complaints(kind, value, where):
    """[sentence ...] of what the API would not take. kind: as python3-kubernetes calls a type."""
    of_list = re.fullmatch(r"list\[(.+)\]", kind)
    of_map = re.fullmatch(r"dict\(str, (.+)\)", kind)
    if of_list:
        if not isinstance(value, list):
            return [f"{where}: not a list"]
        return [c for i, v in enumerate(value) for c in complaints(of_list[1], v, f"{where}[{i}]")]
    if of_map:
        if not isinstance(value, dict):
            return [f"{where}: not a map"]
        return [c for k, v in value.items() for c in complaints(of_map[1], v, f"{where}.{k}")]
    if kind in PLAIN:
        good = isinstance(value, PLAIN[kind]) and (kind == "bool") >= isinstance(value, bool)
        return [] if good or kind == "object" else [f"{where}: {value!r} is no {kind}"]
    return complaints_of_class(getattr(api, kind), value, where)


def complaints_of_class(model, value, where):
    if not isinstance(value, dict):
        return [f"{where}: not a map"]
    names = {field: attribute for attribute, field in model.attribute_map.items()}
    found = [f"{where}.{field}: no such field" for field in value if field not in names]
    for field in value.keys() & names.keys():
        found += complaints(model.openapi_types[names[field]], value[field], f"{where}.{field}")
    for attribute, field in model.attribute_map.items():
        setter = inspect.getsource(getattr(model, attribute).fset)
        if "must not be `None`" in setter and field not in value:
            found.append(f"{where}.{field}: missing")
    return found


def selectors(value):
    """All label selectors at any depth, of services, sets, budgets and policies alike."""
    for key, inner in value.items() if isinstance(value, dict) else ():
        if key in ("selector", "podSelector"):
            yield inner.get("matchLabels", inner)
        elif key != "template":
            yield from selectors(inner)


class KubernetesTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        listed = yaml.safe_load((KUBERNETES / "kustomization.yaml").read_text())["resources"]
        files = {path.name for path in KUBERNETES.glob("*.yaml")} - {"kustomization.yaml"}
        assert set(listed) == files, f"{files} are not {listed}"
        cls.objects = {
            (found := yaml.safe_load((KUBERNETES / name).read_text()))["kind"]: found
            for name in listed
        }
        cls.pod = cls.objects["StatefulSet"]["spec"]["template"]
        cls.container = cls.pod["spec"]["containers"][0]

    def test_every_field_is_one_of_the_api(self):
        for kind, value in self.objects.items():
            model = CLASSES[value["apiVersion"], kind]
            self.assertEqual(complaints_of_class(model, value, kind), [])

    def test_what_is_wrong_is_seen(self):
        wrong = {"metadata": {"name": 7}, "spec": {"maxUnavailable": 0, "replica": 1}}
        self.assertEqual(
            sorted(complaints_of_class(api.V1PodDisruptionBudget, wrong, "it")),
            ["it.metadata.name: 7 is no str", "it.spec.replica: no such field"],
        )
        self.assertIn(
            "it.spec.serviceName: missing",
            complaints_of_class(api.V1StatefulSet, {"spec": {"selector": {}}}, "it"),
        )

    def test_everything_selects_the_pods_of_the_server(self):
        labels = self.pod["metadata"]["labels"]
        for kind, value in self.objects.items():
            found = list(selectors(value["spec"]))
            self.assertEqual(found, [labels], kind)

    def test_ports_and_volumes_that_are_named_are_there(self):
        ports = {port["name"] for port in self.container["ports"]}
        probes = [self.container[f"{kind}Probe"] for kind in ("startup", "readiness", "liveness")]
        named = {probe["httpGet"]["port"] for probe in probes}
        named |= {port["targetPort"] for port in self.objects["Service"]["spec"]["ports"]}
        for rule in self.objects["NetworkPolicy"]["spec"]["ingress"]:
            named |= {port["port"] for port in rule["ports"]}
        self.assertEqual(named, ports)
        service = self.objects["Service"]["metadata"]["name"]
        self.assertEqual(self.objects["StatefulSet"]["spec"]["serviceName"], service)
        claims = self.objects["StatefulSet"]["spec"]["volumeClaimTemplates"]
        volumes = {claim["metadata"]["name"] for claim in claims}
        volumes |= {volume["name"] for volume in self.pod["spec"]["volumes"]}
        self.assertEqual({mount["name"] for mount in self.container["volumeMounts"]}, volumes)

    def test_the_server_takes_what_it_is_started_with(self):
        program = running.BUILD_DIR / "bin/plumescout-server"
        arguments = [a.replace("/certificates/", "/nowhere/") for a in self.container["args"]]
        done = subprocess.run([program, *arguments], capture_output=True, text=True)
        self.assertEqual(done.returncode, 1, "the options are right, and the files are not there")
        self.assertIn("/nowhere/", done.stderr)


class ComposeTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.file = yaml.safe_load(COMPOSE.read_text())

    def test_compose_takes_it(self):
        file = dict(self.file)
        file.pop("name")  # which is younger than Debian's compose
        subprocess.run(
            ["docker-compose", "-f", "-", "--project-directory", COMPOSE.parent, "config", "-q"],
            input=yaml.safe_dump(file),
            text=True,
            check=True,
            cwd=COMPOSE.parent,
        )

    def test_what_it_mounts_ships(self):
        made = {"certificates"}  # as its head says
        for name, service in self.file["services"].items():
            for volume in service.get("volumes", ()):
                source = volume.split(":")[0]
                if source.startswith("."):
                    path = pathlib.Path(COMPOSE.parent, source).resolve()
                    self.assertTrue(path.exists() or path.name in made, f"{name}: {source}")
                else:
                    self.assertIn(source, self.file["volumes"], name)

    def test_nothing_may_write_to_its_root(self):
        for name, service in self.file["services"].items():
            self.assertTrue(service["read_only"], name)
            self.assertEqual(service["cap_drop"], ["ALL"], name)


if __name__ == "__main__":
    unittest.main()
