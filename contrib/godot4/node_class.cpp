#include "pelagic/contrib/godot4/node_class.hpp"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <stdexcept>

namespace pelagic::godot4 {

Engine engine;
Names kept_names;

const char* Engine::load(GDExtensionInterfaceGetProcAddress get_function) {
#define PELAGIC_GODOT_LOAD(function, type)                                            \
    function = reinterpret_cast<GDExtensionInterface##type>(get_function(#function)); \
    if (!function) return #function;
    PELAGIC_GODOT_FUNCTIONS(PELAGIC_GODOT_LOAD)
#undef PELAGIC_GODOT_LOAD
    return nullptr;
}

namespace {

// PropertyHint and PropertyUsageFlags
constexpr std::uint32_t hint_none = 0, hint_range = 1, hint_enum = 2, usage_default = 6, usage_variant = 131072;

std::string number_text(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", value);
    return text;
}

bool is_number(Type type) { return type == type_int || type == type_float; }
bool is_text(Type type) { return type == type_string || type == type_name || type == type_path; }

/// Returns whether the engine converts a value to the type without loss of its meaning.
bool fits(Type type, Type wanted) {
    return type == wanted || wanted == type_any || (is_number(type) && is_number(wanted)) ||
           (is_text(type) && is_text(wanted)) || (type == type_nil && wanted == type_object) ||
           (type == type_array && (wanted == type_vectors || wanted == type_floats || wanted == type_bytes));
}

/// A GDExtensionPropertyInfo with what it points to.
struct Info {
    Info(Type type, std::string_view name, std::string_view class_name, std::uint32_t hint = hint_none,
         std::string_view hint_text = "", std::uint32_t usage = usage_default)
        : text(hint_text),
          info{type == type_any ? type_nil : type,
               named(name).name(),
               named(class_name).name(),
               hint,
               text.string(),
               type == type_any ? usage | usage_variant : usage} {}
    Text text;
    GDExtensionPropertyInfo info;
};

/// Calls `work` and reports what it throws: no exception may leave the library.
template <class Work>
void guarded(const Node& node, const Work& work) {
    try {
        work();
    } catch (const std::exception& error) {
        node.reject(error.what());
    }
}

Node& node_of(GDExtensionClassInstancePtr instance) { return *static_cast<Node*>(instance); }

void enter_tree(GDExtensionClassInstancePtr it, const GDExtensionConstTypePtr*, GDExtensionTypePtr) {
    guarded(node_of(it), [&] { node_of(it).enter_tree(); });
}
void exit_tree(GDExtensionClassInstancePtr it, const GDExtensionConstTypePtr*, GDExtensionTypePtr) {
    guarded(node_of(it), [&] { node_of(it).exit_tree(); });
}
void process(GDExtensionClassInstancePtr it, const GDExtensionConstTypePtr* arguments, GDExtensionTypePtr) {
    guarded(node_of(it), [&] { node_of(it).process(*static_cast<const double*>(arguments[0])); });
}
void physics_process(GDExtensionClassInstancePtr it, const GDExtensionConstTypePtr* arguments, GDExtensionTypePtr) {
    guarded(node_of(it), [&] { node_of(it).physics_process(*static_cast<const double*>(arguments[0])); });
}

Value run(const Method& method, GDExtensionClassInstancePtr instance, std::span<const Value> arguments) {
    Value result = Value::empty(method.result);
    guarded(node_of(instance), [&] { result = method.call(node_of(instance), arguments); });
    return result;
}

}  // namespace

void Node::reject(std::string_view line) const {
    const std::string text = std::string(class_name_) + ": " + std::string(line);
    engine.print_error(text.c_str(), class_name_, "", 0, true);
    self().call("emit_signal", "refused", line);
}

void refuse(std::string_view name, const std::string& value, std::string_view accepted) {
    const bool is_interval = accepted.starts_with('[') || accepted.starts_with('(');
    throw std::invalid_argument(std::string(name) + (is_interval ? " " : " is ") + value +
                                (is_interval ? " is out of range " : ", expected ") + std::string(accepted));
}

double value_of(const Option& option, std::string_view name, const Value& value) {
    if (option.kind == Kind::choice) {
        const std::string wanted = value.text(), names = "," + std::string(option.names) + ",";
        const std::size_t at = wanted.empty() ? std::string::npos : names.find("," + wanted + ",");
        if (!is_text(value.type()) || at == std::string::npos) refuse(name, wanted, option.accepted);
        return static_cast<double>(std::count(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(at), ','));
    }
    if (!is_number(value.type())) refuse(name, value.text(), option.accepted);
    const double number = value.number();
    if (!option.accepts(number)) refuse(name, number_text(number), option.accepted);
    return number;
}

void read_dictionary(std::span<const Option> table, void* options, const Value& dictionary, std::string_view kind) {
    const Value keys = dictionary.call("keys");
    for (std::int64_t i = 0; i < keys.call("size").whole(); ++i) {
        const Value key = keys.at(i);
        const std::string name = key.text();
        const auto found =
            std::find_if(table.begin(), table.end(), [&](const Option& it) { return it.name == name; });
        if (found == table.end()) {
            std::string names;
            for (const Option& option : table) names.append(names.empty() ? "" : ", ").append(option.name);
            refuse("key of a " + std::string(kind), name, "one of " + names);
        }
        found->write(options, value_of(*found, name, dictionary.at(key)));
    }
}

void NodeClass::property(Property property, const std::function<Value(Node&)>& get,
                         const std::function<void(Node&, const Value&)>& set) {
    methods_.push_back(
        {"get_" + property.name, {}, property.type, property.class_name, [get](Node& node, std::span<const Value>) {
             return get(node);
         }});
    methods_.push_back(
        {"set_" + property.name,
         {{"value", property.type}},
         type_nil,
         {},
         [set](Node& node, std::span<const Value> arguments) { return set(node, arguments[0]), Value(); }});
    properties_.push_back(std::move(property));
}

void NodeClass::option(const std::string& prefix, const Option& option,
                       const std::function<const void*(const Node&)>& read,
                       const std::function<void(Node&, const Option&, double)>& write) {
    const std::string name = prefix + option.name;
    const bool is_choice = option.kind == Kind::choice;
    const double low = option.also < option.min ? option.also : option.min;
    std::string hint_text = option.names;
    if (!is_choice)
        hint_text =
            number_text(low) + "," + number_text(option.max) + (option.is_real() ? ",0.0001,or_greater" : ",1");
    const auto get = [&option, read, is_choice](Node& node) {
        const double value = option.read(read(node));
        if (option.is_real()) return Value(value);
        if (!is_choice) return Value(static_cast<std::int64_t>(value));
        std::string_view names = option.names;
        for (int i = 0; i < static_cast<int>(value); ++i) names.remove_prefix(names.find(',') + 1);
        return Value(names.substr(0, names.find(',')));
    };
    const auto set = [&option, read, write, name](Node& node, const Value& value) {
        const double now = option.read(read(node));  // a default may be a value that a scene must replace
        if (is_number(value.type()) && value.number() == now) return;
        const double wanted = value_of(option, name, value);
        if (wanted != now) write(node, option, wanted);
    };
    property({name,
              is_choice          ? type_string
              : option.is_real() ? type_float
                                 : type_int,
              is_choice ? hint_enum : hint_range, hint_text, ""},
             get, set);
}

GDExtensionObjectPtr NodeClass::create(void* data) {
    const NodeClass& self = *static_cast<NodeClass*>(data);
    const GDExtensionObjectPtr object = engine.classdb_construct_object(named(self.parent_).name());
    try {
        engine.object_set_instance(object, named(self.name_).name(), self.make_(object).release());
    } catch (const std::exception& error) {
        engine.print_error(error.what(), self.name_, "", 0, true);
    }
    return object;
}

void NodeClass::call(void* data, GDExtensionClassInstancePtr instance, const GDExtensionConstVariantPtr* arguments,
                     GDExtensionInt count, GDExtensionVariantPtr result, GDExtensionCallError* error) {
    const Method& method = *static_cast<Method*>(data);
    const auto wanted = static_cast<GDExtensionInt>(method.arguments.size());
    error->error = count < wanted   ? GDEXTENSION_CALL_ERROR_TOO_FEW_ARGUMENTS
                   : count > wanted ? GDEXTENSION_CALL_ERROR_TOO_MANY_ARGUMENTS
                                    : GDEXTENSION_CALL_OK;
    error->argument = error->expected = static_cast<std::int32_t>(wanted);
    if (count != wanted) return;
    std::vector<Value> values;
    for (GDExtensionInt i = 0; i < count; ++i) {
        values.push_back(Value::of(arguments[i]));
        const Type type = method.arguments[static_cast<std::size_t>(i)].type;
        if (fits(values.back().type(), type)) continue;
        *error = {GDEXTENSION_CALL_ERROR_INVALID_ARGUMENT, static_cast<std::int32_t>(i),
                  static_cast<std::int32_t>(type)};
        return;
    }
    engine.variant_new_copy(result, run(method, instance, values).variant());  // the engine passes nil
}

void NodeClass::ptrcall(void* data, GDExtensionClassInstancePtr instance, const GDExtensionConstTypePtr* arguments,
                        GDExtensionTypePtr result) {
    const Method& method = *static_cast<Method*>(data);
    std::vector<Value> values;
    for (std::size_t i = 0; i < method.arguments.size(); ++i)
        values.push_back(Value::of(method.arguments[i].type, arguments[i]));
    const Value value = run(method, instance, values);
    if (result && method.result != type_nil) value.write(method.result, result);
}

GDExtensionClassCallVirtual NodeClass::virtual_of(void* data, GDExtensionConstStringNamePtr name) {
    static constexpr std::pair<const char*, GDExtensionClassCallVirtual> all[] = {
        {"_enter_tree", enter_tree},
        {"_exit_tree", exit_tree},
        {"_process", process},
        {"_physics_process", physics_process}};
    // The editor would run the nodes of the scene that it edits, and save where they have moved.
    const auto is_editor = [] { return Value::singleton("Engine").call("is_editor_hint").boolean(); };
    for (const std::string& own : static_cast<NodeClass*>(data)->virtuals_)
        for (const auto& [virtual_name, function] : all)
            if (own == virtual_name && named(own).is(name)) return is_editor() ? nullptr : function;
    return nullptr;
}

void NodeClass::register_class() {
    GDExtensionClassCreationInfo creation{};
    creation.create_instance_func = create;
    creation.free_instance_func = [](void*, GDExtensionClassInstancePtr instance) { delete &node_of(instance); };
    creation.get_virtual_func = virtual_of;
    creation.class_userdata = this;
    void* const name = named(name_).name();
    engine.classdb_register_extension_class(engine.library, name, named(parent_).name(), &creation);
    for (Method& method : methods_) {
        std::deque<Info> arguments;
        std::vector<GDExtensionPropertyInfo> infos;
        for (const Argument& argument : method.arguments) {
            arguments.emplace_back(argument.type, argument.name, "");
            infos.push_back(arguments.back().info);
        }
        std::vector<GDExtensionClassMethodArgumentMetadata> metadata(infos.size(),
                                                                     GDEXTENSION_METHOD_ARGUMENT_METADATA_NONE);
        Info result(method.result, "", method.result_class);
        GDExtensionClassMethodInfo info{};
        info.name = named(method.name).name();
        info.method_userdata = &method;
        info.call_func = call;
        info.ptrcall_func = ptrcall;
        info.method_flags = GDEXTENSION_METHOD_FLAGS_DEFAULT;
        info.has_return_value = method.result != type_nil;
        info.return_value_info = &result.info;
        info.argument_count = static_cast<std::uint32_t>(infos.size());
        info.arguments_info = infos.data();
        info.arguments_metadata = metadata.data();
        engine.classdb_register_extension_class_method(engine.library, name, &info);
    }
    for (const Property& property : properties_) {
        Info info(property.type, property.name, property.class_name, property.hint, property.hint_text);
        engine.classdb_register_extension_class_property(engine.library, name, &info.info,
                                                         named("set_" + property.name).name(),
                                                         named("get_" + property.name).name());
    }
    Info why(type_string, "why", "");
    engine.classdb_register_extension_class_signal(engine.library, name, named("refused").name(), &why.info, 1);
}

void NodeClass::unregister_class() { engine.classdb_unregister_extension_class(engine.library, named(name_).name()); }

}  // namespace pelagic::godot4
