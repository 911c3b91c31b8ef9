// farseer-ffi for C#: the functions of farseer.h as P/Invoke signatures, and a class that frees its simulator.
//
// Copy this file into the game, and put the library (farseer_ffi.dll, libfarseer_ffi.so or libfarseer_ffi.dylib) beside it.
// It needs C# 5 and no other library; Vector2 has the layout of XNA's.
using System;
using System.Collections.Generic;
using System.Runtime.InteropServices;
using System.Text;

namespace FarseerFfi
{
    /// <summary>Result of a call. All but `FARSEER_STATUS_OK`, `_PANICKED` and `_BUFFER_TOO_SMALL` are refusals, which have changed nothing.</summary>
    public enum Status
    {
        /// <summary>The call was carried out.</summary>
        Ok = 0,
        /// <summary>A pointer is null.</summary>
        NullPointer = 1,
        /// <summary>An argument has a value that cannot be accepted: not finite, out of range, no value of its enum.</summary>
        InvalidArgument = 2,
        /// <summary>An id names an object that was disposed.</summary>
        StaleId = 3,
        /// <summary>An id names an object of another kind, or no object.</summary>
        WrongKind = 4,
        /// <summary>The chosen methods do not support it.</summary>
        NotSupported = 5,
        /// <summary>The call would cost more than the engine allows.</summary>
        LimitExceeded = 6,
        /// <summary>The bytes are no snapshot, were altered, or have another version.</summary>
        DamagedSnapshot = 7,
        /// <summary>The caller's array is too short: as many items as it has room for were written, and their full number.</summary>
        BufferTooSmall = 8,
        /// <summary>The call is not possible in the present state.</summary>
        NotNow = 9,
        /// <summary>The engine panicked, in this call or an earlier one. The simulator refuses all further calls; destroy it.</summary>
        Panicked = 10,
    }

    /// <summary>How a simulator computes.</summary>
    public enum Methods
    {
        /// <summary>Farseer Physics 2.1.3, bit for bit.</summary>
        Faithful = 0,
        /// <summary>The precise engine: faster and more accurate, with sleep and continuous collision.</summary>
        Precise = 1,
    }

    /// <summary>Which pairs may touch: the broad phase of the faithful methods. All four find the same pairs, in other orders.</summary>
    public enum BroadPhase
    {
        /// <summary>Sweeps along the better axis. The default.</summary>
        SelectiveSweep = 0,
        /// <summary>Sorted lists that are kept from update to update.</summary>
        SweepAndPrune = 1,
        /// <summary>Tests all pairs.</summary>
        BruteForce = 2,
        /// <summary>A hashed grid, whose cells follow the sizes of the geoms.</summary>
        SpatialHash = 3,
    }

    /// <summary>Where pairs touch: the narrow phase of the faithful methods.</summary>
    public enum NarrowPhase
    {
        /// <summary>A grid of distances for each outline. The default.</summary>
        DistanceGrid = 0,
        /// <summary>Separating axes, for convex outlines.</summary>
        Sat = 1,
    }

    /// <summary>The friction coefficient of a pair.</summary>
    public enum Friction
    {
        /// <summary>The mean of both coefficients. The default.</summary>
        Average = 0,
        /// <summary>The smaller coefficient.</summary>
        Minimum = 1,
    }

    /// <summary>Kinds of bodies.</summary>
    public enum BodyKind
    {
        /// <summary>Forces and contacts move it.</summary>
        Dynamic = 0,
        /// <summary>Its velocity alone moves it.</summary>
        Kinematic = 1,
        /// <summary>It never moves.</summary>
        Static = 2,
    }

    /// <summary>Shapes of geoms.</summary>
    public enum Shape
    {
        /// <summary>`width` by `height`.</summary>
        Rectangle = 0,
        /// <summary>`radius`.</summary>
        Circle = 1,
        /// <summary>Upright: `height` from tip to tip, `radius` of its ends.</summary>
        Capsule = 2,
        /// <summary>The corners `points`, convex or not.</summary>
        Polygon = 3,
        /// <summary>Edges between the `points`, solid from one side, on a static body; under the precise methods.</summary>
        Chain = 4,
        /// <summary>Edges between the `points`, solid from both sides, on a static body; under the precise methods.</summary>
        TwoSidedChain = 5,
        /// <summary>The corners `points`, rounded by `radius`; under the precise methods.</summary>
        RoundedPolygon = 6,
    }

    /// <summary>Events that a geom wants, to be added up.</summary>
    [Flags]
    public enum WantedEvents
    {
        /// <summary>No events.</summary>
        None = 0,
        /// <summary>Begin and end of touches.</summary>
        Touch = 1,
        /// <summary>Begin and end of overlaps with sensors.</summary>
        Sensor = 2,
        /// <summary>Hits.</summary>
        Hit = 4,
    }

    /// <summary>The kinds of events.</summary>
    public enum EventKind
    {
        /// <summary>Geom `first` touches geom `second`: one event for each side. In each update of a touch under the faithful methods, at its begin under the precise ones.</summary>
        Collision = 0,
        /// <summary>Geom `first` does not touch geom `second` any more, or only their boxes overlap: one event for each side.</summary>
        Separation = 1,
        /// <summary>Geoms `first` and `second` begin to touch: one event for the pair, if one of them wants it. This and the next three are events of the precise methods.</summary>
        TouchBegin = 2,
        /// <summary>Geoms `first` and `second` cease to touch.</summary>
        TouchEnd = 3,
        /// <summary>Geom `second` begins to overlap the sensor `first`.</summary>
        SensorBegin = 4,
        /// <summary>Geom `second` ceases to overlap the sensor `first`.</summary>
        SensorEnd = 5,
        /// <summary>Body `first` fell asleep.</summary>
        BodySlept = 6,
        /// <summary>Body `first` is awake again.</summary>
        BodyWoke = 7,
        /// <summary>Body `first` was disposed.</summary>
        BodyDisposed = 8,
        /// <summary>Object `first` entered the simulation.</summary>
        Added = 9,
        /// <summary>Object `first` left the simulation.</summary>
        Removed = 10,
        /// <summary>Joint `first` broke: it is disabled.</summary>
        JointBroke = 11,
        /// <summary>Spring `first` broke: it is disabled.</summary>
        SpringBroke = 12,
        /// <summary>The state of the body, joint or spring `first` would not have been finite: a body was put back and disabled, a joint or spring skipped.</summary>
        NotFinite = 13,
        /// <summary>The engine ignored a value for the object `first`, 0 for the simulator.</summary>
        RejectedInput = 14,
    }

    /// <summary>The kinds of joints.</summary>
    public enum JointKind
    {
        /// <summary>A kind that this interface does not have.</summary>
        Other = 0,
        /// <summary>A hinge between two bodies.</summary>
        Revolute = 1,
        /// <summary>A hinge between a body and the world.</summary>
        FixedRevolute = 2,
        /// <summary>A rod.</summary>
        Pin = 3,
        /// <summary>A range of distances.</summary>
        Slider = 4,
        /// <summary>A relative angle.</summary>
        Angle = 5,
        /// <summary>An angle of a body.</summary>
        FixedAngle = 6,
        /// <summary>A range of relative angles.</summary>
        AngleLimit = 7,
        /// <summary>A range of angles of a body.</summary>
        FixedAngleLimit = 8,
        /// <summary>A point and the relative angle.</summary>
        Weld = 9,
        /// <summary>A line and the relative angle.</summary>
        Prismatic = 10,
        /// <summary>A wheel with suspension.</summary>
        Wheel = 11,
        /// <summary>A spring between angles.</summary>
        AngleSpring = 12,
        /// <summary>A bounded force to a pose.</summary>
        Motor = 13,
        /// <summary>Two bodies that turn in a ratio.</summary>
        Gear = 14,
        /// <summary>A rope over two points.</summary>
        Pulley = 15,
    }

    /// <summary>A point, vector, velocity or force in the plane: x right, y down.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Vector2
    {
        /// <summary>Component to the right, in the unit of the quantity: length units for a point.</summary>
        public float X;
        /// <summary>Component down, in the unit of the quantity: length units for a point.</summary>
        public float Y;

        public Vector2(float x, float y) { X = x; Y = y; }
    }

    /// <summary>Place of a geom on its body: the origin, unless set.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Placement
    {
        /// <summary>Position on the body in length units, before the geom is turned: the rotation turns it, too.</summary>
        public Vector2 Offset;
        /// <summary>Rotation relative to the body in radians.</summary>
        public float RotationOffset;
        /// <summary>Edge of a cell of the distance grid in length units; 0: a tenth of the shorter side.</summary>
        public float CollisionGridSize;
    }

    /// <summary>A body for farseer_body_create. Start from farseer_body_options_default.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct BodyOptions
    {
        /// <summary>Kind code: a BodyKind.</summary>
        public BodyKind Kind;
        /// <summary>Position in length units.</summary>
        public Vector2 Position;
        /// <summary>Rotation in radians.</summary>
        public float Rotation;
        /// <summary>Velocity in length units/s.</summary>
        public Vector2 LinearVelocity;
        /// <summary>Angular velocity in rad/s.</summary>
        public float AngularVelocity;
        /// <summary>Fraction of the velocity that is lost per s.</summary>
        public float LinearDamping;
        /// <summary>Fraction of the angular velocity that is lost per s.</summary>
        public float AngularDamping;
        /// <summary>Factor of gravity.</summary>
        public float GravityScale;
        /// <summary>Mass in mass units; 0: that of the geoms.</summary>
        public float Mass;
        /// <summary>Moment of inertia in mass units · length units²; 0: that of the geoms.</summary>
        public float MomentOfInertia;
        /// <summary>Flag: whether the body never turns.</summary>
        public int RotationLocked;
        /// <summary>Flag: whether continuous collision acts against all bodies.</summary>
        public int Bullet;
        /// <summary>Flag: whether the body may fall asleep.</summary>
        public int SleepAllowed;
        /// <summary>Flag: whether the body takes part.</summary>
        public int Enabled;
        /// <summary>A number of yours: the tag.</summary>
        public ulong Tag;
    }

    /// <summary>A geom. Start from farseer_geom_options_default.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct GeomOptions
    {
        /// <summary>Shape code: a Shape.</summary>
        public Shape Shape;
        /// <summary>Width of a rectangle in length units.</summary>
        public float Width;
        /// <summary>Height of a rectangle or a capsule in length units.</summary>
        public float Height;
        /// <summary>Radius of a circle, of the ends of a capsule or of rounded corners, in length units.</summary>
        public float Radius;
        /// <summary>Points of polygons and chains, in length units; read by the call alone.</summary>
        public IntPtr Points;
        /// <summary>Number of points.</summary>
        public UIntPtr PointCount;
        /// <summary>Position on the body in length units.</summary>
        public Vector2 Offset;
        /// <summary>Rotation relative to the body in radians.</summary>
        public float RotationOffset;
        /// <summary>Mass per square of a length unit; 0: the engine's default.</summary>
        public float Density;
        /// <summary>Mass in mass units, instead of a density; 0: by the density.</summary>
        public float Mass;
        /// <summary>Friction coefficient.</summary>
        public float Friction;
        /// <summary>Restitution coefficient, 0 to 1.</summary>
        public float Restitution;
        /// <summary>Bit mask: the categories of the geom.</summary>
        public int Categories;
        /// <summary>Bit mask: the categories that it collides with.</summary>
        public int CollidesWith;
        /// <summary>Group number: geoms of one group other than 0 do not collide.</summary>
        public int Group;
        /// <summary>Flag: whether it is a sensor, which exerts no impulses.</summary>
        public int Sensor;
        /// <summary>Bit mask: a sum of WantedEvents; -1: touches and sensors under the precise methods.</summary>
        public int WantedEvents;
        /// <summary>A number of yours: the tag.</summary>
        public ulong Tag;
    }

    /// <summary>Which geoms a query finds. Start from farseer_query_filter_default.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct QueryFilter
    {
        /// <summary>Bit mask: geoms of at least one of these categories are found.</summary>
        public int Categories;
        /// <summary>Bit mask: categories of the query itself, with which a geom has to collide.</summary>
        public int AsCategories;
        /// <summary>Flag: whether geoms of static bodies are found.</summary>
        public int StaticBodies;
        /// <summary>Flag: whether geoms of kinematic bodies are found.</summary>
        public int KinematicBodies;
        /// <summary>Flag: whether geoms of dynamic bodies are found.</summary>
        public int DynamicBodies;
        /// <summary>Flag: whether sensors are found.</summary>
        public int Sensors;
        /// <summary>Id of a body that is not found; 0 for none.</summary>
        public ulong ExcludeBody;
        /// <summary>Id of a geom that is not found; 0 for none.</summary>
        public ulong ExcludeGeom;
    }

    /// <summary>The point at which a ray enters a geom.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct RayHit
    {
        /// <summary>Id of the geom.</summary>
        public ulong Geom;
        /// <summary>The point in the world, in length units.</summary>
        public Vector2 Point;
        /// <summary>Outward unit normal at the point.</summary>
        public Vector2 Normal;
        /// <summary>Fraction of the distance from start to end, 0 to 1.</summary>
        public float Fraction;
    }

    /// <summary>An event of the last update.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Event
    {
        /// <summary>Kind code: a EventKind.</summary>
        public EventKind Kind;
        /// <summary>Number of contacts of a collision; else 0.</summary>
        public uint Contacts;
        /// <summary>The object of the event. Ids of disposed objects are stale.</summary>
        public ulong First;
        /// <summary>Id of the other geom; else 0.</summary>
        public ulong Second;
    }

    /// <summary>Two geoms that hit each other.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Hit
    {
        /// <summary>Id of one geom.</summary>
        public ulong Geom1;
        /// <summary>Id of the other geom.</summary>
        public ulong Geom2;
        /// <summary>The contact point that closes fastest, in the world, in length units.</summary>
        public Vector2 Point;
        /// <summary>Unit normal from the first geom to the second.</summary>
        public Vector2 Normal;
        /// <summary>Speed along the normal before the impact, in length units/s.</summary>
        public float Speed;
    }

    /// <summary>A contact of a body.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct BodyContact
    {
        /// <summary>Id of the geom of the body.</summary>
        public ulong Geom;
        /// <summary>Id of the other geom.</summary>
        public ulong Other;
        /// <summary>The point in the world, in length units.</summary>
        public Vector2 Point;
        /// <summary>Unit normal from the other geom to the body: up for a body that stands.</summary>
        public Vector2 Normal;
        /// <summary>Separation in length units, negative for penetration.</summary>
        public float Separation;
        /// <summary>Normal impulse of the last update, under the precise methods of its last substep, in mass units · length units/s.</summary>
        public float NormalImpulse;
    }

    /// <summary>A call was refused; the message names the argument and its value.</summary>
    public sealed class FarseerException : Exception
    {
        /// <summary>Why it was refused.</summary>
        public readonly Status Status;

        public FarseerException(Status status, string message) : base(message) { Status = status; }
    }

    /// <summary>The simulator of the library. It is freed once, and not while a call uses it.</summary>
    public sealed class SimulatorHandle : SafeHandle
    {
        public SimulatorHandle() : base(IntPtr.Zero, true) { }

        public override bool IsInvalid { get { return handle == IntPtr.Zero; } }

        protected override bool ReleaseHandle()
        {
            Native.farseer_simulator_destroy(handle);
            return true;
        }
    }

    /// <summary>A simulator. All other calls are in Native, with Handle as their first argument; Check throws if they are refused.</summary>
    public sealed class Simulator : IDisposable
    {
        /// <summary>The argument of the functions in Native.</summary>
        public readonly SimulatorHandle Handle;

        /// <summary>Gravity in length units/s², y down.</summary>
        public Simulator(Methods methods, Vector2 gravity)
        {
            Handle = Native.farseer_simulator_create((int)methods, gravity);
            if (Handle.IsInvalid)
            {
                throw new FarseerException(Status.InvalidArgument, LastError());
            }
        }

        public void Dispose() { Handle.Dispose(); }

        /// <summary>Throws if a call was refused.</summary>
        public static void Check(Status status)
        {
            if (status != Status.Ok)
            {
                throw new FarseerException(status, LastError());
            }
        }

        /// <summary>The message of the last refused call of this thread.</summary>
        public static string LastError()
        {
            IntPtr text = Native.farseer_last_error();
            var bytes = new List<byte>();
            for (byte next; (next = Marshal.ReadByte(text, bytes.Count)) != 0;)
            {
                bytes.Add(next);
            }
            return Encoding.UTF8.GetString(bytes.ToArray());
        }

        /// <summary>Advances the simulation by dt s.</summary>
        public void Update(float dt) { Check(Native.farseer_simulator_update(Handle, dt)); }

        /// <summary>Hash of the complete state.</summary>
        public ulong StateHash
        {
            get
            {
                ulong hash;
                Check(Native.farseer_simulator_state_hash(Handle, out hash));
                return hash;
            }
        }

        /// <summary>The bodies that take part, in the order of their list.</summary>
        public ulong[] Bodies()
        {
            UIntPtr count;
            Check(Native.farseer_simulator_bodies(Handle, null, UIntPtr.Zero, out count));
            var bodies = new ulong[(int)count];
            Check(Native.farseer_simulator_bodies(Handle, bodies, count, out count));
            return bodies;
        }

        /// <summary>The events of the last update.</summary>
        public Event[] Events()
        {
            UIntPtr count;
            Check(Native.farseer_simulator_events(Handle, null, UIntPtr.Zero, out count));
            var events = new Event[(int)count];
            Check(Native.farseer_simulator_events(Handle, events, count, out count));
            return events;
        }

        /// <summary>Adds a body with one geom; points for polygons and chains, else null.</summary>
        public ulong AddBody(BodyOptions body, GeomOptions geom, Vector2[] points)
        {
            GCHandle pin = GCHandle.Alloc(points, GCHandleType.Pinned);
            try
            {
                geom.Points = pin.AddrOfPinnedObject();
                geom.PointCount = (UIntPtr)(points == null ? 0 : points.Length);
                ulong id;
                Check(Native.farseer_body_create(Handle, ref body, new[] { geom }, (UIntPtr)1, out id, null));
                return id;
            }
            finally
            {
                pin.Free();
            }
        }

        /// <summary>The complete simulator as bytes.</summary>
        public byte[] Snapshot()
        {
            UIntPtr length;
            Check(Native.farseer_simulator_take_snapshot(Handle, out length));
            var bytes = new byte[(int)length];
            Check(Native.farseer_simulator_copy_snapshot(Handle, bytes, length, out length));
            return bytes;
        }

        /// <summary>Goes back to a snapshot. Forget ids that were made since.</summary>
        public void Restore(byte[] snapshot)
        {
            Check(Native.farseer_simulator_restore(Handle, snapshot, (UIntPtr)snapshot.Length));
        }
    }

    /// <summary>The functions of farseer.h, whose comments describe them.</summary>
    public static class Native
    {
        const string Library = "farseer_ffi";
        const CallingConvention C = CallingConvention.Cdecl;

        [DllImport(Library, CallingConvention = C)] public static extern IntPtr farseer_last_error();
        [DllImport(Library, CallingConvention = C)] public static extern IntPtr farseer_version();
        [DllImport(Library, CallingConvention = C)] public static extern SimulatorHandle farseer_simulator_create(
            int methods, Vector2 gravity);
        [DllImport(Library, CallingConvention = C)] public static extern void farseer_simulator_destroy(IntPtr simulator);

        // Settings of a simulator.
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_simulator_gravity(SimulatorHandle simulator, out Vector2 gravity);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_simulator_set_gravity(SimulatorHandle simulator, Vector2 gravity);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_simulator_enabled(SimulatorHandle simulator, out int enabled);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_simulator_set_enabled(SimulatorHandle simulator, int enabled);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_simulator_iterations(SimulatorHandle simulator, out int iterations);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_simulator_set_iterations(SimulatorHandle simulator, int iterations);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_simulator_bias_factor(SimulatorHandle simulator, out float biasFactor);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_simulator_set_bias_factor(SimulatorHandle simulator, float biasFactor);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_simulator_allowed_penetration(
            SimulatorHandle simulator, out float allowedPenetration);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_simulator_set_allowed_penetration(
            SimulatorHandle simulator, float allowedPenetration);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_simulator_max_contacts_to_detect(
            SimulatorHandle simulator, out int maxContactsToDetect);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_simulator_set_max_contacts_to_detect(
            SimulatorHandle simulator, int maxContactsToDetect);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_simulator_max_contacts_to_resolve(
            SimulatorHandle simulator, out int maxContactsToResolve);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_simulator_set_max_contacts_to_resolve(
            SimulatorHandle simulator, int maxContactsToResolve);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_simulator_sleep_enabled(SimulatorHandle simulator, out int sleepEnabled);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_simulator_set_sleep_enabled(SimulatorHandle simulator, int sleepEnabled);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_simulator_set_friction_type(SimulatorHandle simulator, int frictionType);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_simulator_set_broad_phase(SimulatorHandle simulator, int broadPhase);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_simulator_set_narrow_phase(SimulatorHandle simulator, int narrowPhase);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_simulator_set_length_unit(SimulatorHandle simulator, float lengthUnit);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_simulator_set_largest_speed(SimulatorHandle simulator, float largestSpeed);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_simulator_set_hit_speed(SimulatorHandle simulator, float hitSpeed);
        // Properties of bodies.
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_position(SimulatorHandle simulator, ulong body, out Vector2 position);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_set_position(SimulatorHandle simulator, ulong body, Vector2 position);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_rotation(SimulatorHandle simulator, ulong body, out float rotation);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_set_rotation(SimulatorHandle simulator, ulong body, float rotation);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_total_rotation(
            SimulatorHandle simulator, ulong body, out float totalRotation);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_linear_velocity(
            SimulatorHandle simulator, ulong body, out Vector2 linearVelocity);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_set_linear_velocity(
            SimulatorHandle simulator, ulong body, Vector2 linearVelocity);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_angular_velocity(
            SimulatorHandle simulator, ulong body, out float angularVelocity);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_set_angular_velocity(
            SimulatorHandle simulator, ulong body, float angularVelocity);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_mass(SimulatorHandle simulator, ulong body, out float mass);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_set_mass(SimulatorHandle simulator, ulong body, float mass);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_moment_of_inertia(
            SimulatorHandle simulator, ulong body, out float momentOfInertia);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_set_moment_of_inertia(
            SimulatorHandle simulator, ulong body, float momentOfInertia);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_linear_drag_coefficient(
            SimulatorHandle simulator, ulong body, out float linearDragCoefficient);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_set_linear_drag_coefficient(
            SimulatorHandle simulator, ulong body, float linearDragCoefficient);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_rotational_drag_coefficient(
            SimulatorHandle simulator, ulong body, out float rotationalDragCoefficient);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_set_rotational_drag_coefficient(
            SimulatorHandle simulator, ulong body, float rotationalDragCoefficient);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_gravity_scale(SimulatorHandle simulator, ulong body, out float gravityScale);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_set_gravity_scale(SimulatorHandle simulator, ulong body, float gravityScale);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_ignore_gravity(SimulatorHandle simulator, ulong body, out int ignoreGravity);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_set_ignore_gravity(SimulatorHandle simulator, ulong body, int ignoreGravity);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_is_static(SimulatorHandle simulator, ulong body, out int isStatic);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_set_is_static(SimulatorHandle simulator, ulong body, int isStatic);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_is_kinematic(SimulatorHandle simulator, ulong body, out int isKinematic);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_set_is_kinematic(SimulatorHandle simulator, ulong body, int isKinematic);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_is_bullet(SimulatorHandle simulator, ulong body, out int isBullet);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_set_is_bullet(SimulatorHandle simulator, ulong body, int isBullet);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_enabled(SimulatorHandle simulator, ulong body, out int enabled);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_set_enabled(SimulatorHandle simulator, ulong body, int enabled);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_rotation_locked(
            SimulatorHandle simulator, ulong body, out int rotationLocked);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_set_rotation_locked(
            SimulatorHandle simulator, ulong body, int rotationLocked);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_sleep_allowed(SimulatorHandle simulator, ulong body, out int sleepAllowed);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_set_sleep_allowed(SimulatorHandle simulator, ulong body, int sleepAllowed);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_sleep_events(SimulatorHandle simulator, ulong body, out int sleepEvents);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_set_sleep_events(SimulatorHandle simulator, ulong body, int sleepEvents);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_tag(SimulatorHandle simulator, ulong body, out ulong tag);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_set_tag(SimulatorHandle simulator, ulong body, ulong tag);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_world_position(
            SimulatorHandle simulator, ulong body, Vector2 local, out Vector2 world);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_local_position(
            SimulatorHandle simulator, ulong body, Vector2 world, out Vector2 local);
        // Forces, impulses, motion and sleep of bodies.
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_apply_force(SimulatorHandle simulator, ulong body, Vector2 force);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_apply_force_at_world_point(
            SimulatorHandle simulator, ulong body, Vector2 force, Vector2 point);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_apply_torque(SimulatorHandle simulator, ulong body, float torque);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_apply_impulse(SimulatorHandle simulator, ulong body, Vector2 impulse);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_apply_impulse_at_world_point(
            SimulatorHandle simulator, ulong body, Vector2 impulse, Vector2 point);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_apply_angular_impulse(SimulatorHandle simulator, ulong body, float impulse);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_clear_forces(SimulatorHandle simulator, ulong body);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_reset_dynamics(SimulatorHandle simulator, ulong body);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_move_to(
            SimulatorHandle simulator, ulong body, Vector2 position, float rotation);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_sleep(SimulatorHandle simulator, ulong body);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_wake(SimulatorHandle simulator, ulong body);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_is_asleep(SimulatorHandle simulator, ulong body, out int isAsleep);
        // Bodies as Farseer's factories make them.
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_create_rectangle(
            SimulatorHandle simulator, float width, float height, float mass, out ulong body);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_create_circle(
            SimulatorHandle simulator, float radius, float mass, out ulong body);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_create_ellipse(
            SimulatorHandle simulator, float xRadius, float yRadius, float mass, out ulong body);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_create_capsule(
            SimulatorHandle simulator, float height, float endRadius, float mass, out ulong body);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_create_with_inertia(
            SimulatorHandle simulator, float mass, float momentOfInertia, out ulong body);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_create_polygon(
            SimulatorHandle simulator, [In] Vector2[] points, UIntPtr count, float mass, out ulong body);
        // Properties of geoms.
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_geom_friction_coefficient(
            SimulatorHandle simulator, ulong geom, out float frictionCoefficient);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_geom_set_friction_coefficient(
            SimulatorHandle simulator, ulong geom, float frictionCoefficient);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_geom_restitution_coefficient(
            SimulatorHandle simulator, ulong geom, out float restitutionCoefficient);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_geom_set_restitution_coefficient(
            SimulatorHandle simulator, ulong geom, float restitutionCoefficient);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_geom_collision_categories(
            SimulatorHandle simulator, ulong geom, out int collisionCategories);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_geom_set_collision_categories(
            SimulatorHandle simulator, ulong geom, int collisionCategories);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_geom_collides_with(SimulatorHandle simulator, ulong geom, out int collidesWith);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_geom_set_collides_with(SimulatorHandle simulator, ulong geom, int collidesWith);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_geom_collision_group(
            SimulatorHandle simulator, ulong geom, out int collisionGroup);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_geom_set_collision_group(
            SimulatorHandle simulator, ulong geom, int collisionGroup);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_geom_collision_enabled(
            SimulatorHandle simulator, ulong geom, out int collisionEnabled);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_geom_set_collision_enabled(
            SimulatorHandle simulator, ulong geom, int collisionEnabled);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_geom_collision_response_enabled(
            SimulatorHandle simulator, ulong geom, out int collisionResponseEnabled);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_geom_set_collision_response_enabled(
            SimulatorHandle simulator, ulong geom, int collisionResponseEnabled);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_geom_tag(SimulatorHandle simulator, ulong geom, out ulong tag);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_geom_set_tag(SimulatorHandle simulator, ulong geom, ulong tag);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_geom_set_sensor(SimulatorHandle simulator, ulong geom, int sensor);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_geom_set_wanted_events(SimulatorHandle simulator, ulong geom, int wantedEvents);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_geom_set_one_way(SimulatorHandle simulator, ulong geom, Vector2 direction);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_geom_ignore_collision_with(SimulatorHandle simulator, ulong geom, ulong other);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_geom_restore_collision_with(SimulatorHandle simulator, ulong geom, ulong other);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_geom_body(SimulatorHandle simulator, ulong geom, out ulong body);
        // Geoms as Farseer's factories make them.
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_geom_create_rectangle(
            SimulatorHandle simulator, ulong body, float width, float height, ref Placement placement, out ulong geom);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_geom_create_circle(
            SimulatorHandle simulator, ulong body, float radius, int edges, ref Placement placement, out ulong geom);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_geom_create_ellipse(
            SimulatorHandle simulator, ulong body, float xRadius, float yRadius, int edges, ref Placement placement, out ulong geom);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_geom_create_capsule(
            SimulatorHandle simulator, ulong body, float height, float endRadius, int edges, ref Placement placement, out ulong geom);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_geom_create_polygon(
            SimulatorHandle simulator, ulong body, [In] Vector2[] points, UIntPtr count, ref Placement placement, out ulong geom);
        // Joints of all kinds.
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_joint_create_revolute(
            SimulatorHandle simulator, ulong body1, ulong body2, Vector2 anchor, out ulong joint);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_joint_create_fixed_revolute(
            SimulatorHandle simulator, ulong body, Vector2 anchor, out ulong joint);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_joint_create_pin(
            SimulatorHandle simulator, ulong body1, Vector2 anchor1, ulong body2, Vector2 anchor2, out ulong joint);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_joint_create_slider(
            SimulatorHandle simulator, ulong body1, Vector2 anchor1, ulong body2, Vector2 anchor2, float min, float max, out ulong joint);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_joint_create_angle(
            SimulatorHandle simulator, ulong body1, ulong body2, out ulong joint);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_joint_create_fixed_angle(SimulatorHandle simulator, ulong body, out ulong joint);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_joint_create_angle_limit(
            SimulatorHandle simulator, ulong body1, ulong body2, float min, float max, out ulong joint);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_joint_create_fixed_angle_limit(
            SimulatorHandle simulator, ulong body, float min, float max, out ulong joint);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_joint_create_weld(
            SimulatorHandle simulator, ulong body1, ulong body2, Vector2 anchor, out ulong joint);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_joint_create_prismatic(
            SimulatorHandle simulator, ulong body1, ulong body2, Vector2 anchor, Vector2 axis, out ulong joint);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_joint_create_wheel(
            SimulatorHandle simulator, ulong body1, ulong body2, Vector2 anchor, Vector2 axis, float stiffness, float damping, out ulong joint);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_joint_create_angle_spring(
            SimulatorHandle simulator, ulong body1, ulong body2, float stiffness, float damping, out ulong joint);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_joint_create_motor(
            SimulatorHandle simulator, ulong body1, ulong body2, float frequency, float dampingRatio, float greatestForce, float greatestTorque, out ulong joint);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_joint_create_gear(
            SimulatorHandle simulator, ulong body1, ulong body2, float ratio, out ulong joint);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_joint_create_pulley(
            SimulatorHandle simulator, ulong body1, Vector2 anchor1, Vector2 pulley1, ulong body2, Vector2 anchor2, Vector2 pulley2, float ratio, out ulong joint);
        // Properties of joints of all kinds.
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_joint_enabled(SimulatorHandle simulator, ulong joint, out int enabled);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_joint_set_enabled(SimulatorHandle simulator, ulong joint, int enabled);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_joint_bias_factor(SimulatorHandle simulator, ulong joint, out float biasFactor);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_joint_set_bias_factor(SimulatorHandle simulator, ulong joint, float biasFactor);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_joint_softness(SimulatorHandle simulator, ulong joint, out float softness);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_joint_set_softness(SimulatorHandle simulator, ulong joint, float softness);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_joint_breakpoint(SimulatorHandle simulator, ulong joint, out float breakpoint);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_joint_set_breakpoint(SimulatorHandle simulator, ulong joint, float breakpoint);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_joint_greatest_force(
            SimulatorHandle simulator, ulong joint, out float greatestForce);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_joint_set_greatest_force(
            SimulatorHandle simulator, ulong joint, float greatestForce);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_joint_greatest_torque(
            SimulatorHandle simulator, ulong joint, out float greatestTorque);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_joint_set_greatest_torque(
            SimulatorHandle simulator, ulong joint, float greatestTorque);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_joint_force(SimulatorHandle simulator, ulong joint, out Vector2 force);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_joint_torque(SimulatorHandle simulator, ulong joint, out float torque);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_joint_error(SimulatorHandle simulator, ulong joint, out float error);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_joint_tag(SimulatorHandle simulator, ulong joint, out ulong tag);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_joint_set_tag(SimulatorHandle simulator, ulong joint, ulong tag);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_joint_kind(SimulatorHandle simulator, ulong joint, out int kind);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_joint_set_bodies_collide(
            SimulatorHandle simulator, ulong joint, int bodiesCollide);
        // Motors, limits, servos, targets and ranges of joints.
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_joint_set_motor(
            SimulatorHandle simulator, ulong joint, float speed, float greatestEffort);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_joint_remove_motor(SimulatorHandle simulator, ulong joint);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_joint_set_limits(SimulatorHandle simulator, ulong joint, float lower, float upper);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_joint_remove_limits(SimulatorHandle simulator, ulong joint);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_joint_set_servo(
            SimulatorHandle simulator, ulong joint, float target, float stiffness, float damping, float greatestEffort);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_joint_remove_servo(SimulatorHandle simulator, ulong joint);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_joint_set_range(SimulatorHandle simulator, ulong joint, float lower, float upper);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_joint_set_target(SimulatorHandle simulator, ulong joint, float target);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_joint_set_motor_target(
            SimulatorHandle simulator, ulong joint, Vector2 offset, float angle);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_joint_travel(SimulatorHandle simulator, ulong joint, out float travel);
        // Springs.
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_spring_create_linear(
            SimulatorHandle simulator, ulong body1, Vector2 point1, ulong body2, Vector2 point2, float springConstant, float dampingConstant, out ulong spring);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_spring_create_fixed_linear(
            SimulatorHandle simulator, ulong body, Vector2 bodyPoint, Vector2 worldPoint, float springConstant, float dampingConstant, out ulong spring);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_spring_create_angle(
            SimulatorHandle simulator, ulong body1, ulong body2, float springConstant, float dampingConstant, out ulong spring);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_spring_create_fixed_angle(
            SimulatorHandle simulator, ulong body, float springConstant, float dampingConstant, out ulong spring);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_spring_enabled(SimulatorHandle simulator, ulong spring, out int enabled);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_spring_set_enabled(SimulatorHandle simulator, ulong spring, int enabled);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_spring_spring_constant(
            SimulatorHandle simulator, ulong spring, out float springConstant);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_spring_set_spring_constant(
            SimulatorHandle simulator, ulong spring, float springConstant);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_spring_damping_constant(
            SimulatorHandle simulator, ulong spring, out float dampingConstant);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_spring_set_damping_constant(
            SimulatorHandle simulator, ulong spring, float dampingConstant);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_spring_breakpoint(SimulatorHandle simulator, ulong spring, out float breakpoint);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_spring_set_breakpoint(SimulatorHandle simulator, ulong spring, float breakpoint);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_spring_error(SimulatorHandle simulator, ulong spring, out float error);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_spring_tag(SimulatorHandle simulator, ulong spring, out ulong tag);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_spring_set_tag(SimulatorHandle simulator, ulong spring, ulong tag);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_spring_set_target(SimulatorHandle simulator, ulong spring, float target);
        // Life of objects of all kinds, and lists of them.
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_object_dispose(SimulatorHandle simulator, ulong number);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_object_remove(SimulatorHandle simulator, ulong number);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_object_add(SimulatorHandle simulator, ulong number);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_object_is_disposed(SimulatorHandle simulator, ulong number, out int isDisposed);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_simulator_bodies(
            SimulatorHandle simulator, [In, Out] ulong[] bodies, UIntPtr capacity, out UIntPtr count);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_simulator_geoms(
            SimulatorHandle simulator, [In, Out] ulong[] geoms, UIntPtr capacity, out UIntPtr count);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_simulator_joints(
            SimulatorHandle simulator, [In, Out] ulong[] joints, UIntPtr capacity, out UIntPtr count);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_simulator_springs(
            SimulatorHandle simulator, [In, Out] ulong[] springs, UIntPtr capacity, out UIntPtr count);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_geoms(
            SimulatorHandle simulator, ulong body, [In, Out] ulong[] geoms, UIntPtr capacity, out UIntPtr count);
        // Poses and velocities of many bodies in one call.
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_bodies_read(
            SimulatorHandle simulator, [In] ulong[] bodies, UIntPtr count, [In, Out] Vector2[] positions, [In, Out] float[] rotations, [In, Out] Vector2[] linearVelocities, [In, Out] float[] angularVelocities);
        // Life and update of a simulator.
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_simulator_update(SimulatorHandle simulator, float dt);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_simulator_clear(SimulatorHandle simulator);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_simulator_methods(SimulatorHandle simulator, out int methods);
        // Snapshots and hashes.
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_simulator_state_hash(SimulatorHandle simulator, out ulong hash);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_simulator_take_snapshot(SimulatorHandle simulator, out UIntPtr length);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_simulator_copy_snapshot(
            SimulatorHandle simulator, [In, Out] byte[] bytes, UIntPtr capacity, out UIntPtr length);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_simulator_restore(SimulatorHandle simulator, [In] byte[] bytes, UIntPtr length);
        // Events, hits and contacts of the last update, as lists.
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_simulator_events(
            SimulatorHandle simulator, [In, Out] Event[] events, UIntPtr capacity, out UIntPtr count);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_simulator_hits(
            SimulatorHandle simulator, [In, Out] Hit[] hits, UIntPtr capacity, out UIntPtr count);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_contacts(
            SimulatorHandle simulator, ulong body, [In, Out] BodyContact[] contacts, UIntPtr capacity, out UIntPtr count);
        // Queries of rays, points and boxes.
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_simulator_cast_ray(
            SimulatorHandle simulator, Vector2 start, Vector2 end, ref QueryFilter filter, out RayHit hit, out int found);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_simulator_cast_ray_all(
            SimulatorHandle simulator, Vector2 start, Vector2 end, ref QueryFilter filter, [In, Out] RayHit[] hits, UIntPtr capacity, out UIntPtr count);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_simulator_geoms_at(
            SimulatorHandle simulator, Vector2 point, ref QueryFilter filter, [In, Out] ulong[] geoms, UIntPtr capacity, out UIntPtr count);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_simulator_geoms_in_box(
            SimulatorHandle simulator, Vector2 min, Vector2 max, [In, Out] ulong[] geoms, UIntPtr capacity, out UIntPtr count);
        // Bodies described by options, with their geoms in one call.
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_options_default(out BodyOptions options);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_create(
            SimulatorHandle simulator, ref BodyOptions options, [In] GeomOptions[] geoms, UIntPtr count, out ulong body, [In, Out] ulong[] ids);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_body_set_density(SimulatorHandle simulator, ulong body, float density);
        // Geoms described by options.
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_geom_options_default(out GeomOptions options);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_geom_create(
            SimulatorHandle simulator, ulong body, ref GeomOptions options, out ulong geom);
        [DllImport(Library, CallingConvention = C)] public static extern Status farseer_query_filter_default(out QueryFilter filter);
    }
}
