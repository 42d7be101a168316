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
ROUTER = running.ROOT / "deploy/cluster/haproxy.cfg"
CLUSTER = running.ROOT / "deploy/kubernetes_cluster"
COMPOSE = running.ROOT / "deploy/container/compose.yaml"
CLASSES = {
    ("v1", "Service"): api.V1Service,
    ("apps/v1", "StatefulSet"): api.V1StatefulSet,
    ("apps/v1", "Deployment"): api.V1Deployment,
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

    def test_who_recovers_for_long_is_not_killed(self):
        paths = {k: self.container[f"{k}Probe"]["httpGet"]["path"] for k in ("startup", "liveness")}
        self.assertEqual(paths, {"startup": "/healthz", "liveness": "/healthz"})
        self.assertEqual(self.container["readinessProbe"]["httpGet"]["path"], "/readyz")

    def test_the_server_takes_what_it_is_started_with(self):
        program = running.BUILD_DIR / "bin/plumescout-server"
        arguments = [a.replace("/certificates/", "/nowhere/") for a in self.container["args"]]
        done = subprocess.run([program, *arguments], capture_output=True, text=True)
        self.assertEqual(done.returncode, 1, "the options are right, and the files are not there")
        self.assertIn("/nowhere/", done.stderr)


class KubernetesClusterTest(unittest.TestCase):
    """Patches are read as they stand: what they leave out is in deploy/kubernetes."""

    @classmethod
    def setUpClass(cls):
        cls.own = {path.name: yaml.safe_load(path.read_text()) for path in CLUSTER.glob("*.yaml")}
        cls.patches = {p.name: yaml.safe_load(p.read_text()) for p in CLUSTER.glob("node/*.yaml")}
        cls.files = {p.parent.name: yaml.safe_load(p.read_text()) for p in CLUSTER.glob("n?/*.yaml")}
        cls.top, cls.node = cls.own.pop("kustomization.yaml"), cls.patches.pop("kustomization.yaml")
        cls.router = cls.own["router.yaml"]["spec"]["template"]

    def node_patch(self, name):
        patch = yaml.safe_load(self.files[name]["patches"][0]["patch"])
        return patch, patch["spec"]["template"]["spec"]

    def test_all_files_are_used_and_there(self):
        self.assertEqual(set(self.top["resources"]), {*self.files, *self.own})
        self.assertEqual({patch["path"] for patch in self.node["patches"]}, set(self.patches))
        for folder, file in (("node", self.node), *self.files.items()):
            for resource in file["resources"]:
                self.assertTrue((CLUSTER / folder / resource / "kustomization.yaml").exists())

    def test_every_field_is_one_of_the_api(self):
        for name, value in self.own.items():
            model = CLASSES[value["apiVersion"], value["kind"]]
            self.assertEqual(complaints_of_class(model, value, name), [])
        patches = [*self.patches.values(), *(self.node_patch(name)[0] for name in self.files)]
        for value in patches:
            value.get("spec", {}).pop("volumeClaimTemplates", None)  # null: there are none
            value.get("spec", {}).pop("clusterIP", None)
            found = complaints_of_class(CLASSES[value["apiVersion"], value["kind"]], value, "patch")
            self.assertEqual([c for c in found if not c.endswith(": missing")], [])

    def test_the_router_leads_to_all_nodes_by_their_names(self):
        containers = {c["name"]: c for c in self.router["spec"]["containers"]}
        environment = {e["name"]: e["value"] for e in containers["router"]["env"]}
        for number, name in enumerate(sorted(self.files), 1):
            self.assertEqual(environment[f"PLUMESCOUT_NODE_{number}"], f"plumescout-{name}:50551")
            self.assertEqual(self.files[name]["nameSuffix"], f"-{name}")
            [own] = self.node_patch(name)[1]["containers"][0]["env"]
            self.assertEqual(own, {"name": "PLUMESCOUT_NODE", "value": name})
            [volume] = self.node_patch(name)[1]["volumes"]
            self.assertEqual(volume["secret"]["secretName"], f"plumescout-tls-{name}")
        listed = [line.split() for line in ROUTER.read_text().splitlines()]
        self.assertEqual({w[1] for w in listed if w[:1] == ["server"]}, set(self.files))

    def test_everything_of_the_router_finds_its_pods(self):
        labels = self.router["metadata"]["labels"]
        for name, value in self.own.items():
            for selector in selectors(value["spec"]):
                self.assertEqual(selector, labels, name)
        [rule, _] = self.patches["network.yaml"]["spec"]["ingress"]
        [expression] = rule["from"][0]["podSelector"]["matchExpressions"]
        self.assertEqual(labels, {expression["key"]: expression["values"][0]})
        volumes = {volume["name"] for volume in self.router["spec"]["volumes"]}
        for container in self.router["spec"]["containers"]:
            self.assertLessEqual({mount["name"] for mount in container["volumeMounts"]}, volumes)

    def test_imports_of_a_node_are_put_aside_on_a_disk(self):
        base = yaml.safe_load((KUBERNETES / "server.yaml").read_text())["spec"]["template"]["spec"]
        patch = self.patches["server.yaml"]["spec"]["template"]["spec"]
        volumes = {v["name"]: v for v in (*base["volumes"], *patch["volumes"])}
        mounts = {m["mountPath"]: m["name"] for m in base["containers"][0]["volumeMounts"]}
        for container in patch["containers"]:
            if any(a.startswith("--store=postgresql:") for a in container["args"]):
                environment = {e["name"]: e.get("value") for e in container["env"]}
                volume = volumes[mounts[environment["TMPDIR"]]]
                self.assertNotEqual(volume["emptyDir"].get("medium"), "Memory")

    def test_a_node_takes_what_it_is_started_with(self):
        arguments = self.patches["server.yaml"]["spec"]["template"]["spec"]["containers"][0]["args"]
        arguments = [a.replace("$(PLUMESCOUT_NODE)", "n1") for a in arguments]
        arguments = [a.replace("@database:5432/", "@127.0.0.1:1/") for a in arguments]
        program = running.BUILD_DIR / "bin/plumescout-server"
        done = subprocess.run([program, *arguments], capture_output=True, text=True)
        self.assertEqual(done.returncode, 1, "the options are right, and there is no database")
        self.assertIn("127.0.0.1:1/plumescout", done.stderr)


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

    def test_nothing_fails_because_a_server_recovers_for_long(self):
        on_server = self.file["services"]["front"]["depends_on"]["server"]
        self.assertEqual(on_server["condition"], "service_started")

    def test_nothing_may_write_to_its_root(self):
        for name, service in self.file["services"].items():
            self.assertTrue(service["read_only"], name)
            self.assertEqual(service["cap_drop"], ["ALL"], name)


if __name__ == "__main__":
    unittest.main()
