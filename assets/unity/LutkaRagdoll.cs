// Adds the ragdoll of a *.ragdoll.json (lutka build MODEL -o NAME.ragdoll.json) to a model in the scene: Rigidbody, colliders and
// ConfigurableJoint. Put this file into a folder named Editor, select the model's root, choose Tools > Lutka > Add Ragdoll.
//
// Unverified: no Unity was at hand. The file is right-handed, Unity left-handed: everything is mirrored along x, as Unity's FBX
// importer does. Compare one hinge (a knee) with `lutka render MODEL --seconds 0 --debug limits -o limits.png` first; when it
// bends the wrong way, your importer mirrors another axis.
using System;
using System.Collections.Generic;
using System.IO;
using System.Text.RegularExpressions;
using UnityEditor;
using UnityEngine;

public static class LutkaRagdoll
{
    [Serializable] class Frame { public float[] rotation; public float[] translation; }
    [Serializable] class Primitive { public string kind; public float radius; public float halfLength; public float[] halfExtents; public float[] points; }
    [Serializable] class AddedShape : Primitive { public Frame bodyFromShape; }
    [Serializable] class Shape : Primitive { public AddedShape[] more; }
    [Serializable] class Body { public string name; public string joint; public Shape shape; public Frame jointFromBody; public float massKg; public float[] inertia; }
    [Serializable] class Hinge { public float lower; public float upper; }
    [Serializable] class Cone { public float swingY; public float swingZ; public float twist; }
    [Serializable] class Constraint { public string child; public string parent; public string kind; public Frame parentFromFrame; public Frame childFromFrame; public Hinge hinge; public Cone cone; }
    [Serializable] class Profile { public Body[] bodies; public Constraint[] constraints; }

    class Part { public Body body; public Transform joint; public Rigidbody rigid; public List<Collider> colliders; }

    static Vector3 Position(float[] v) { return new Vector3(-v[0], v[1], v[2]); }
    static Quaternion Rotation(float[] q) { return new Quaternion(q[0], -q[1], -q[2], q[3]); }

    [MenuItem("Tools/Lutka/Add Ragdoll")]
    static void AddRagdoll()
    {
        GameObject root = Selection.activeGameObject;
        if (root == null) { Debug.LogError("Lutka: select the model's root first"); return; }
        string file = EditorUtility.OpenFilePanel("Ragdoll profile", "", "json");
        if (string.IsNullOrEmpty(file)) return;
        string text = WithFlatPoints(File.ReadAllText(file));
        Profile profile = JsonUtility.FromJson<Profile>(text);
        var parts = new Dictionary<string, Part>();
        foreach (Body body in profile.bodies)
        {
            Transform joint = Find(root.transform, body.joint);
            if (joint == null) { Debug.LogError("Lutka: no bone named " + body.joint); return; }
            parts[body.name] = AddBody(body, joint);
        }
        foreach (Constraint constraint in profile.constraints)
            AddJoint(constraint, parts[constraint.parent], parts[constraint.child]);
        foreach (Match pair in FilteredPairs(text))
            foreach (Collider first in parts[pair.Groups[1].Value].colliders)
                foreach (Collider second in parts[pair.Groups[2].Value].colliders)
                    Physics.IgnoreCollision(first, second);
        Debug.Log("Lutka: " + parts.Count + " bodies. Ignored pairs hold until the scene is loaded again: ignore them in a script of yours, too.");
    }

    static Transform Find(Transform at, string name)
    {
        if (at.name == name) return at;
        foreach (Transform child in at)
        {
            Transform found = Find(child, name);
            if (found != null) return found;
        }
        return null;
    }

    // Arrays in arrays are more than JsonUtility reads: a hull's points become one array of numbers.
    static string WithFlatPoints(string text)
    {
        return Regex.Replace(text, "\"points\":\\s*\\[([^\"{}]*)\\]",
            match => "\"points\": [" + match.Groups[1].Value.Replace("[", "").Replace("]", "") + "]");
    }

    // So are these.
    static MatchCollection FilteredPairs(string text)
    {
        int start = text.IndexOf("\"filteredPairs\"", StringComparison.Ordinal);
        int end = text.IndexOf("\"notes\"", start, StringComparison.Ordinal);
        string list = end > start ? text.Substring(start, end - start) : text.Substring(start);
        return Regex.Matches(list, "\\[\\s*\"([^\"]+)\",\\s*\"([^\"]+)\"\\s*\\]");
    }

    // Lengths of the file are metres; a bone may be scaled.
    static float UnitsPerMetre(Transform joint) { return 1f / Mathf.Max(1e-6f, Mathf.Abs(joint.lossyScale.x)); }

    static Part AddBody(Body body, Transform joint)
    {
        float units = UnitsPerMetre(joint);
        var holder = new GameObject("Body " + body.name);
        Undo.RegisterCreatedObjectUndo(holder, "Add Ragdoll");
        holder.transform.SetParent(joint, false);
        holder.transform.localPosition = units * Position(body.jointFromBody.translation);
        holder.transform.localRotation = Rotation(body.jointFromBody.rotation);
        Rigidbody rigid = Undo.AddComponent<Rigidbody>(joint.gameObject);
        var colliders = new List<Collider> { AddCollider(holder, body.shape, units) };
        if (body.shape.more != null)
            foreach (AddedShape added in body.shape.more)
                colliders.Add(AddCollider(AddedHolder(holder, added, units), added, units));
        rigid.mass = body.massKg;
        rigid.centerOfMass = units * Position(body.jointFromBody.translation);
        rigid.inertiaTensor = new Vector3(body.inertia[0], body.inertia[1], body.inertia[2]);
        rigid.inertiaTensorRotation = Rotation(body.jointFromBody.rotation);
        rigid.solverIterations = 30;
        return new Part { body = body, joint = joint, rigid = rigid, colliders = colliders };
    }

    static GameObject AddedHolder(GameObject holder, AddedShape added, float units)
    {
        var below = new GameObject(holder.name + " more");
        below.transform.SetParent(holder.transform, false);
        below.transform.localPosition = units * Position(added.bodyFromShape.translation);
        below.transform.localRotation = Rotation(added.bodyFromShape.rotation);
        return below;
    }

    static Collider AddCollider(GameObject holder, Primitive shape, float units)
    {
        if (shape.kind == "capsule")
        {
            CapsuleCollider capsule = holder.AddComponent<CapsuleCollider>();
            capsule.direction = 1;
            capsule.radius = units * shape.radius;
            capsule.height = units * 2f * (shape.halfLength + shape.radius);
            return capsule;
        }
        if (shape.kind == "sphere")
        {
            SphereCollider sphere = holder.AddComponent<SphereCollider>();
            sphere.radius = units * shape.radius;
            return sphere;
        }
        if (shape.kind == "hull")
        {
            MeshCollider hull = holder.AddComponent<MeshCollider>();
            hull.sharedMesh = HullMesh(shape.points, units);
            hull.convex = true;
            return hull;
        }
        BoxCollider box = holder.AddComponent<BoxCollider>();
        box.size = units * 2f * new Vector3(shape.halfExtents[0], shape.halfExtents[1], shape.halfExtents[2]);
        return box;
    }

    // Unity makes the hull of the vertices; triangles it only demands.
    static Mesh HullMesh(float[] points, float units)
    {
        var vertices = new Vector3[points.Length / 3];
        for (int i = 0; i < vertices.Length; ++i)
            vertices[i] = units * Position(new[] { points[3 * i], points[3 * i + 1], points[3 * i + 2] });
        var triangles = new List<int>();
        for (int i = 2; i < vertices.Length; ++i)
            triangles.AddRange(new[] { 0, i - 1, i });
        return new Mesh { vertices = vertices, triangles = triangles.ToArray() };
    }

    static Quaternion FrameInJoint(Part part, Frame frame) { return Rotation(part.body.jointFromBody.rotation) * Rotation(frame.rotation); }
    static Vector3 AnchorInJoint(Part part, Frame frame)
    {
        Vector3 inBody = Rotation(part.body.jointFromBody.rotation) * Position(frame.translation);
        return UnitsPerMetre(part.joint) * (Position(part.body.jointFromBody.translation) + inBody);
    }

    // Unity takes the pose in which a joint is made as its zero: the child is put into the neutral pose for that moment.
    static void AddJoint(Constraint constraint, Part parent, Part child)
    {
        Quaternion inChild = FrameInJoint(child, constraint.childFromFrame);
        Quaternion inParent = FrameInJoint(parent, constraint.parentFromFrame);
        Quaternion kept = child.joint.rotation;
        child.joint.rotation = parent.joint.rotation * inParent * Quaternion.Inverse(inChild);
        Physics.SyncTransforms();
        ConfigurableJoint joint = Undo.AddComponent<ConfigurableJoint>(child.joint.gameObject);
        joint.autoConfigureConnectedAnchor = false;
        joint.connectedBody = parent.rigid;
        joint.anchor = AnchorInJoint(child, constraint.childFromFrame);
        joint.connectedAnchor = AnchorInJoint(parent, constraint.parentFromFrame);
        joint.xMotion = joint.yMotion = joint.zMotion = ConfigurableJointMotion.Locked;
        joint.angularXMotion = ConfigurableJointMotion.Limited;
        bool hinge = constraint.kind == "hinge";
        joint.axis = inChild * (hinge ? Vector3.forward : Vector3.right);
        joint.secondaryAxis = inChild * Vector3.up;
        joint.angularYMotion = joint.angularZMotion = hinge ? ConfigurableJointMotion.Locked : ConfigurableJointMotion.Limited;
        if (hinge)
        {
            // Mirroring along x turns the sign of angles about z.
            joint.lowAngularXLimit = Limit(-constraint.hinge.upper);
            joint.highAngularXLimit = Limit(-constraint.hinge.lower);
        }
        else
        {
            joint.lowAngularXLimit = Limit(-constraint.cone.twist);
            joint.highAngularXLimit = Limit(constraint.cone.twist);
            joint.angularYLimit = Limit(constraint.cone.swingY);
            joint.angularZLimit = Limit(constraint.cone.swingZ);
        }
        joint.projectionMode = JointProjectionMode.PositionAndRotation;
        child.joint.rotation = kept;
    }

    static SoftJointLimit Limit(float radians) { return new SoftJointLimit { limit = radians * Mathf.Rad2Deg }; }
}
